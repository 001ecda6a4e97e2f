// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/gtc/quaternion.hpp>

#include "studio/scene/gltf/accessor.h"
#include "studio/scene/gltf/mesh.h"

namespace penumbra::studio::gltf {

/// EXT_mesh_gpu_instancing: where the copies of a node's mesh stand, in the node's space.
using Copies = std::vector<glm::dmat4>;

struct Node {
    std::string pointer, name;
    glm::dvec3 translation{0};
    glm::dquat rotation{1, 0, 0, 0};
    glm::dvec3 scale{1};
    std::optional<glm::dmat4> matrix;  ///< instead of the three above
    int parent = -1;
    bool inScene = false;  ///< belongs to the scene that is loaded
    int mesh = -1, skin = -1;
    std::optional<Copies> copies;  ///< of the mesh, instead of the one at the node's own place
    std::vector<float> weights;    ///< of morph targets; empty: the mesh's own
    std::optional<bool> casts;     ///< unset: unless it is glass
    bool receives = true;
    bool visible = true;  ///< KHR_node_visibility: with its mesh and its light, and all below it
};

struct Skin {
    std::vector<int> joints;  ///< nodes
    std::vector<glm::mat4> jointFromMesh;
};

glm::dmat4 composed(const glm::dvec3& translation, const glm::dquat& rotation, const glm::dvec3& scale);

/// The node hierarchy: a forest.
struct Hierarchy {
    std::vector<Node> nodes;
    std::vector<int> order;  ///< all nodes, parents before children
    std::vector<Skin> skins;
};

/// Checks that every node has one parent at most and no node is its own ancestor; marks the nodes of the
/// scene
/// (`wanted`, else the file's default, else its first, else all). Names go to scene.name and scene.nodeNames.
Hierarchy loadHierarchy(const JsonView& root, const Accessors& accessors,
                        const std::vector<MeshGroup>& meshes, std::optional<int> wanted, Budget& budget,
                        Scene& scene);

}  // namespace penumbra::studio::gltf
