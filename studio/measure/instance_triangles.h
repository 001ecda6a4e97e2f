// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "studio/scene/scene.h"

namespace penumbra::studio {

/// Calls `visit` with the corners of each triangle of an instance, in world space.
template <typename Visit>
void forEachTriangle(const Scene& scene, const Instance& instance, const Visit& visit) {
    const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
    const auto& positions = instance.positions.empty() ? mesh.positions : instance.positions;
    const glm::dmat4 worldFromMesh(instance.worldFromMesh);
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        std::array<glm::dvec3, 3> corners;
        for (std::size_t corner = 0; corner < 3; ++corner)
            corners[corner] = worldFromMesh * glm::dvec4(positions[mesh.indices[i + corner]], 1);
        visit(corners);
    }
}

}  // namespace penumbra::studio
