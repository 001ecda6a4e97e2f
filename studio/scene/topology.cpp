// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/topology.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <utility>
#include <vector>

namespace penumbra::studio {
namespace {

/// A position by its bits, so that equal means equal (and a NaN equals itself).
std::array<std::uint32_t, 3> bitsOf(const glm::vec3& position) {
    const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value + 0.0f); };  // -0 + 0 = 0
    return {bits(position.x), bits(position.y), bits(position.z)};
}

/// For each vertex, the number of its position among the different ones; and how many there are.
std::pair<std::vector<std::uint32_t>, std::size_t> weld(std::span<const glm::vec3> positions) {
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, {}, [&](std::uint32_t i) { return bitsOf(positions[i]); });

    std::vector<std::uint32_t> welded(positions.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i == 0 || bitsOf(positions[order[i]]) != bitsOf(positions[order[i - 1]])) ++count;
        welded[order[i]] = std::uint32_t(count - 1);
    }
    return {std::move(welded), count};
}

/// One triangle's use of an edge, between a < b.
struct EdgeUse {
    std::uint32_t a = 0, b = 0;
    bool forwards = false;  ///< walked from a to b
    auto operator<=>(const EdgeUse&) const = default;
};

}  // namespace

Topology analyzeTopology(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices) {
    Topology topology;
    topology.triangles = indices.size() / 3;
    topology.vertices = positions.size();
    const auto [welded, weldedCount] = weld(positions);
    topology.weldedVertices = weldedCount;

    std::vector<EdgeUse> uses;
    uses.reserve(3 * topology.triangles);
    for (std::size_t triangle = 0; triangle < topology.triangles; ++triangle) {
        const std::array corners{welded[indices[3 * triangle]], welded[indices[3 * triangle + 1]],
                                 welded[indices[3 * triangle + 2]]};
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
            ++topology.degenerateTriangles;
            continue;
        }
        for (int i = 0; i < 3; ++i) {
            const auto from = corners[i], to = corners[(i + 1) % 3];
            uses.push_back({std::min(from, to), std::max(from, to), from < to});
        }
    }
    std::ranges::sort(uses);

    for (auto first = uses.begin(); first != uses.end();) {
        const auto last = std::find_if(
            first, uses.end(), [&](const EdgeUse& use) { return use.a != first->a || use.b != first->b; });
        const auto count = last - first;
        ++topology.edges;
        if (count == 1) ++topology.boundaryEdges;
        if (count >= 3) ++topology.nonManifoldEdges;
        if (count == 2 && first->forwards == (first + 1)->forwards) ++topology.flippedEdges;
        first = last;
    }
    return topology;
}

}  // namespace penumbra::studio
