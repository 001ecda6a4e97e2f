// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/solid.h"

namespace penumbra::studio {

Solid joinMeshes(const Scene& scene, std::span<const int> meshes) {
    Solid solid;
    for (const int index : meshes) {
        const Mesh& mesh = scene.meshes[std::size_t(index)];
        const auto first = std::uint32_t(solid.positions.size());
        solid.positions.insert(solid.positions.end(), mesh.positions.begin(), mesh.positions.end());
        for (const std::uint32_t corner : mesh.indices) solid.indices.push_back(first + corner);
    }
    return solid;
}

}  // namespace penumbra::studio
