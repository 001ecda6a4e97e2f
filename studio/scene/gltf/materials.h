// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "studio/scene/gltf/accessor.h"
#include "studio/scene/scene.h"

namespace penumbra::studio::gltf {

/// Where a material's texture takes its coordinates from; baked into Mesh::uvs.
struct UvSource {
    int texCoord = 0;
    glm::mat3 transform{1};  ///< KHR_texture_transform, on (u, v, 1)
    bool operator==(const UvSource&) const = default;
};

/// Fills scene.pictures, textures and materials, the last material being glTF's default one. Only pictures
/// that base colours and emission use are decoded. Returns one UvSource a material; without a value: the
/// material has no texture.
std::vector<std::optional<UvSource>> loadMaterials(const JsonView& root, const Accessors& accessors,
                                                   const std::filesystem::path& folder, Glass glass,
                                                   Budget& budget, Scene& scene);

}  // namespace penumbra::studio::gltf
