// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "studio/scene/gltf/accessor.h"
#include "studio/scene/gltf/materials.h"
#include "studio/scene/scene.h"

namespace penumbra::studio::gltf {

/// A glTF mesh: several meshes of the scene, one a primitive that has triangles.
struct MeshGroup {
    struct Part {
        int mesh = 0;  ///< index into Scene::meshes
        /// Has no normals in the file: they follow from its triangles as they deform
        bool flatShaded = false;
    };
    /// Where the origin of its positions lies in the file's mesh: they are kept near it, where floats are
    /// fine.
    glm::dvec3 origin{0};
    std::vector<Part> parts;
    std::size_t targetCount = 0;   ///< morph targets, the same in all primitives
    std::uint32_t jointCount = 0;  ///< 1 + the largest joint that a vertex names; 0: not skinned
};

/// Fills scene.meshes; returns one group a glTF mesh. `uvSources` are loadMaterials'.
std::vector<MeshGroup> loadMeshes(const JsonView& root, const Accessors& accessors,
                                  const std::vector<std::optional<UvSource>>& uvSources, Budget& budget,
                                  Scene& scene);

/// A unit normal a vertex of a list of unshared vertices, three a triangle. (0, 0, 1) where a triangle has no
/// area.
std::vector<glm::vec3> flatNormals(const std::vector<glm::vec3>& positions);

}  // namespace penumbra::studio::gltf
