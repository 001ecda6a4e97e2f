// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/exact_visibility/triangle_tree.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace penumbra::exact_visibility {
namespace {

float halfArea(const TreeBox& box) {
    const glm::vec3 extent = glm::max(box.max - box.min, glm::vec3(0));
    return extent.x * extent.y + extent.y * extent.z + extent.z * extent.x;
}

class Builder {
  public:
    Builder(std::span<const TreeBox> boxes, std::uint32_t largestLeaf)
        : boxes_(boxes), largestLeaf_(largestLeaf), order_(boxes.size()), centers_(boxes.size()) {
        std::iota(order_.begin(), order_.end(), 0u);
        std::ranges::transform(boxes, centers_.begin(),
                               [](const TreeBox& box) { return 0.5f * (box.min + box.max); });
        shape_.nodes.reserve(2 * boxes.size());
    }

    TreeShape build() {
        // Nodes come out in depth-first order. The stack holds ranges yet to be split, and ends of subtrees.
        struct Task {
            std::size_t begin, end;
            std::uint32_t closes;  // a node whose subtree is complete, or none
        };
        constexpr std::uint32_t none = 0xffffffffu;
        std::vector<Task> stack;
        if (!boxes_.empty()) stack.push_back({0, boxes_.size(), none});
        while (!stack.empty()) {
            const Task task = stack.back();
            stack.pop_back();
            const auto node = std::uint32_t(shape_.nodes.size());
            if (task.closes != none) {
                shape_.nodes[task.closes].skip = node;
            } else if (const std::size_t middle = split(task.begin, task.end); middle == task.end) {
                shape_.nodes.push_back(
                    {node + 1, std::uint32_t(task.begin), std::uint32_t(task.end - task.begin)});
            } else {
                shape_.nodes.push_back({0, 0, 0});
                stack.push_back({0, 0, node});
                stack.push_back({middle, task.end, none});
                stack.push_back({task.begin, middle, none});
            }
        }
        shape_.order = std::move(order_);
        return std::move(shape_);
    }

  private:
    static constexpr int binCount = 16;
    /// What it costs to visit both children of a node, in looks at a box of a leaf.
    static constexpr float visitCost = 2;
    struct Bin {
        TreeBox box;
        std::size_t count = 0;
    };

    /// Orders the range so that two parts stand one after the other, and says where the second one begins.
    /// Neither is empty, unless the range had better stay a leaf.
    std::size_t split(std::size_t begin, std::size_t end) {
        if (end - begin == 1) return end;
        TreeBox centers, whole;
        for (std::size_t i = begin; i < end; ++i) {
            centers.add(centers_[order_[i]]);
            whole.add(boxes_[order_[i]]);
        }
        const glm::vec3 extent = centers.max - centers.min;
        int bestAxis = -1, bestBin = 0;
        float bestCost = std::numeric_limits<float>::infinity();
        const auto binOf = [&](std::uint32_t box, int axis) {
            const float place = (centers_[box][axis] - centers.min[axis]) / extent[axis];
            return std::clamp(int(place * binCount), 0, binCount - 1);
        };
        for (int axis = 0; axis < 3; ++axis) {
            if (!(extent[axis] > 0)) continue;
            std::array<Bin, binCount> bins;
            for (std::size_t i = begin; i < end; ++i) {
                Bin& bin = bins[std::size_t(binOf(order_[i], axis))];
                bin.box.add(boxes_[order_[i]]);
                ++bin.count;
            }
            std::array<float, binCount> right{};
            Bin sum;
            for (int b = binCount - 1; b > 0; --b) {
                sum.box.add(bins[std::size_t(b)].box);
                sum.count += bins[std::size_t(b)].count;
                right[std::size_t(b)] = sum.count > 0 ? halfArea(sum.box) * float(sum.count) : 0;
            }
            sum = {};
            for (int b = 1; b < binCount; ++b) {
                sum.box.add(bins[std::size_t(b - 1)].box);
                sum.count += bins[std::size_t(b - 1)].count;
                if (sum.count == 0 || sum.count == end - begin) continue;
                const float cost = halfArea(sum.box) * float(sum.count) + right[std::size_t(b)];
                if (cost < bestCost) bestCost = cost, bestAxis = axis, bestBin = b;
            }
        }
        const bool mayStay = end - begin <= largestLeaf_;
        if (mayStay && halfArea(whole) * (float(end - begin) - visitCost) <= bestCost) return end;
        if (bestAxis < 0) return begin + (end - begin) / 2;  // all in one place
        const auto at = [&](std::size_t i) { return order_.begin() + std::ptrdiff_t(i); };
        const auto middle = std::partition(at(begin), at(end),
                                           [&](std::uint32_t box) { return binOf(box, bestAxis) < bestBin; });
        return std::size_t(middle - order_.begin());
    }

    std::span<const TreeBox> boxes_;
    std::uint32_t largestLeaf_;
    std::vector<std::uint32_t> order_;
    std::vector<glm::vec3> centers_;
    TreeShape shape_;
};

}  // namespace

TreeShape buildTree(std::span<const TreeBox> boxes, std::uint32_t largestLeaf) {
    return Builder(boxes, largestLeaf).build();
}

}  // namespace penumbra::exact_visibility
