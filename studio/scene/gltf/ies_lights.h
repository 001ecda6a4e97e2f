// SPDX-License-Identifier: Apache-2.0
// EXT_lights_ies: luminaires whose LM-63 file is named by the scene's, or lies within it.
#pragma once

#include "studio/scene/gltf/accessor.h"
#include "studio/scene/gltf/lights.h"

namespace penumbra::studio::gltf {

/// One for each node of the scene that carries a luminaire. Files lie beneath `folder`.
std::vector<PlacedLight> loadIesLights(const JsonView& root, const Hierarchy& hierarchy,
                                       const Accessors& accessors, const std::filesystem::path& folder,
                                       Budget& budget, Scene& scene);

}  // namespace penumbra::studio::gltf
