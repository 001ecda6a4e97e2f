// SPDX-License-Identifier: Apache-2.0
// Coarser geometry for what is far from whom it shadows: at some nodes of a mesh's tree, fewer triangles that
// stand for all below. Their rims are the mesh's own, so that a walk may take a node's stand-in or what it
// stands for, node by node, and finds no gap.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "penumbra/math.h"
#include "src/techniques/exact_visibility/triangle_tree.h"

namespace penumbra::exact_visibility {

/// In place of a node's triangles.
struct StandIn {
    std::uint32_t node;
    float deviation;           ///< metres of mesh space: see PatchSimplifier
    std::size_t first, count;  ///< of StandIns::triangles
};

struct StandIns {
    std::vector<StandIn> list;           ///< ascending by node
    std::vector<std::uint32_t> indices;  ///< of the mesh's vertices, three a triangle
};

/// Meshes with fewer triangles have none: their trees are walked quickly enough.
constexpr std::size_t leastForStandIns = 16384;

/// At nodes with four times as many triangles as the last below them, each made from those below it.
StandIns makeStandIns(const TreeShape& shape, std::span<const Vec3> positions,
                      std::span<const std::uint32_t> indices);

}  // namespace penumbra::exact_visibility
