// SPDX-License-Identifier: Apache-2.0
// A random scene as the few numbers that it is made from, so that a scene on which two answers differ can be
// made smaller and written down.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "studio/scene/scene.h"

namespace penumbra::studio {

struct Recipe {
    enum class Setting { ground, room };
    enum class Shape { box, sphere, cylinder, cone, torus, sheet };

    struct Part {
        Shape shape = Shape::box;
        glm::vec3 place{0}, size{1};  ///< of its bounding box; y of `place` is its lowest point
        float turn_rad = 0, tilt_rad = 0;
        bool mirrored = false;
    };
    struct Lamp {
        LightShape shape = LightShape::rect;
        glm::vec3 place{0, 2, 0}, target{0};
        float size_m = 0.5f, aspect = 1;
        bool flush = false;  ///< a panel in the ceiling's own plane
    };

    Setting setting = Setting::ground;
    float scale = 1;   ///< metres a unit: everything else is in units of what stands on the ground
    float extent = 4;  ///< of the ground or the room
    std::vector<Part> parts;
    Lamp lamp;
    glm::vec3 eye{0, 2, 5}, lookAt{0};
};

/// The `index`th recipe of a seed.
Recipe randomRecipe(std::uint64_t seed, int index);

Scene cook(const Recipe& recipe);

/// What a person needs to make the scene again by hand.
std::string describe(const Recipe& recipe);

}  // namespace penumbra::studio
