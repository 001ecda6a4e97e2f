// SPDX-License-Identifier: Apache-2.0
// The makers behind the catalog in builtin.cpp.
#pragma once

#include "studio/scene/scene.h"

namespace penumbra::studio::builtin {

// Colours of the built-in scenes, linear Rec. 709.
inline constexpr glm::vec3 terracotta{0.62f, 0.20f, 0.11f};
inline constexpr glm::vec3 mustard{0.72f, 0.44f, 0.08f};
inline constexpr glm::vec3 teal{0.07f, 0.34f, 0.34f};
inline constexpr glm::vec3 slate{0.14f, 0.22f, 0.42f};
inline constexpr glm::vec3 plum{0.38f, 0.10f, 0.24f};
inline constexpr glm::vec3 sage{0.28f, 0.42f, 0.20f};
inline constexpr glm::vec3 cream{0.78f, 0.72f, 0.60f};

// scenes_figures.cpp
Scene primitives();
Scene torus();
Scene sphere();
Scene diskAndSphere();
Scene overlappingBlockers();
Scene twoBoxes();
Scene cylinder();

// scenes_closed_form.cpp
Scene halfPlane();
Scene strip();
Scene diskOverGround();

// scenes_showcase.cpp
Scene columns();
Scene moving();
Scene texturedWindow();
Scene manyLights();

// scenes_rooms.cpp
Scene office();
Scene sunnyWindow();
Scene lampShade();

}  // namespace penumbra::studio::builtin
