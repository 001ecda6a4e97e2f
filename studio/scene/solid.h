// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "studio/scene/scene.h"

namespace penumbra::studio {

/// Several meshes as one: what blocks light is a solid, not the surfaces of one material each that files
/// break it into.
struct Solid {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
};
Solid joinMeshes(const Scene& scene, std::span<const int> meshes);

}  // namespace penumbra::studio
