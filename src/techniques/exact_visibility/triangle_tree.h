// SPDX-License-Identifier: Apache-2.0
// A bounding volume hierarchy over a mesh's triangles, in depth-first order with skip links (Smits 1998,
// "Efficiency issues for ray tracing"): it is walked without a stack, and a walk can stop at any node and be
// taken up there later.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace penumbra::exact_visibility {

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

/// The shape of a tree over `n` boxes: 2 n - 1 nodes at most. Says nothing about where the boxes are, so that
/// it can be kept while they move.
struct TreeShape {
    struct Node {
        std::uint32_t skip;   ///< the next node where this one is not entered; the number of nodes at the end
        std::uint32_t first;  ///< leaves: their first box's place in `order`
        std::uint32_t count;  ///< leaves: of boxes; 0: an inner node, whose first child is the next node
    };
    std::vector<Node> nodes;
    std::vector<std::uint32_t> order;  ///< of the boxes, so that those of a leaf stand side by side
};

/// Splits by the surface area heuristic over 16 bins (Wald 2007), down to leaves of at most `largestLeaf`
/// boxes where that is expected to be cheaper than splitting them.
TreeShape buildTree(std::span<const TreeBox> boxes, std::uint32_t largestLeaf);

/// The boxes of all nodes; `boxOf` tells a leaf's.
template <typename BoxOfLeaf>
void refitTree(const TreeShape& shape, const BoxOfLeaf& boxOf, std::vector<TreeBox>& result) {
    result.resize(shape.nodes.size());
    // Children stand behind their parents.
    for (std::size_t i = shape.nodes.size(); i-- > 0;) {
        const TreeShape::Node& node = shape.nodes[i];
        if (node.count > 0) {
            result[i] = boxOf(node);
        } else {
            result[i] = result[i + 1];
            result[i].add(result[shape.nodes[i + 1].skip]);
        }
    }
}

}  // namespace penumbra::exact_visibility
