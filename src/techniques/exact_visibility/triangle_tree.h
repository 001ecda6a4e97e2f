// SPDX-License-Identifier: Apache-2.0
// A bounding volume hierarchy over a mesh's triangles, in depth-first order with skip links (Smits 1998,
// "Efficiency issues for ray tracing"): it is walked without a stack, and a walk can stop at any node and be
// taken up there later.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace penumbra {

struct TreeBox {
    glm::vec3 min{1e38f}, max{-1e38f};

    void add(const glm::vec3& p) {
        min = glm::min(min, p);
        max = glm::max(max, p);
    }
    void add(const TreeBox& box) {
        min = glm::min(min, box.min);
        max = glm::max(max, box.max);
    }
};

/// The shape of a tree over `n` boxes: 2 n - 1 nodes. Says nothing about where the boxes are, so that it can
/// be kept while they move.
struct TreeShape {
    static constexpr std::uint32_t inner = 0xffffffffu;
    struct Node {
        std::uint32_t skip;  ///< the next node where this one is not entered; the number of nodes at the end
        std::uint32_t leaf;  ///< which box, or `inner`: then the first child is the next node
    };
    std::vector<Node> nodes;
};

/// Splits by the surface area heuristic over 16 bins (Wald 2007), down to a single box a leaf.
TreeShape buildTree(std::span<const TreeBox> boxes);

/// The boxes of all nodes, from those of the leaves.
std::vector<TreeBox> refitTree(const TreeShape& shape, std::span<const TreeBox> boxes);

}  // namespace penumbra
