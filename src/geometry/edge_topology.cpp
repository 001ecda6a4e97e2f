// SPDX-License-Identifier: Apache-2.0
#include "src/geometry/edge_topology.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <tuple>

namespace penumbra {
namespace {

using Bits = std::array<std::uint32_t, 3>;

Bits bitsOf(const Vec3& p) {
    // Adding zero turns -0 into 0.
    return {std::bit_cast<std::uint32_t>(p.x + 0.0f), std::bit_cast<std::uint32_t>(p.y + 0.0f),
            std::bit_cast<std::uint32_t>(p.z + 0.0f)};
}

/// For each position the first one that is equal to it.
std::vector<std::uint32_t> weld(std::span<const Vec3> positions) {
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return bitsOf(positions[i]); });
    std::vector<std::uint32_t> first(positions.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool sameAsBefore = i > 0 && bitsOf(positions[order[i]]) == bitsOf(positions[order[i - 1]]);
        first[order[i]] = sameAsBefore ? first[order[i - 1]] : order[i];
    }
    return first;
}

}  // namespace

EdgeTopology findEdges(std::span<const Vec3> positions, std::span<const std::uint32_t> indices) {
    struct Side {
        std::uint32_t a, b, face;
    };
    const std::vector<std::uint32_t> welded = weld(positions);
    std::vector<Side> sides;
    sides.reserve(indices.size());
    for (std::uint32_t triangle = 0; triangle < indices.size() / 3; ++triangle) {
        const std::array corners = {welded[indices[3 * triangle]], welded[indices[3 * triangle + 1]],
                                    welded[indices[3 * triangle + 2]]};
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t from = corners[i], to = corners[(i + 1) % 3];
            sides.push_back({std::min(from, to), std::max(from, to), 2 * triangle + (from > to ? 1u : 0u)});
        }
    }
    std::ranges::sort(sides, {}, [](const Side& side) { return std::tuple(side.a, side.b, side.face); });

    EdgeTopology topology;
    for (const Side& side : sides) {
        std::vector<EdgeTopology::Edge>& edges = topology.edges;
        if (edges.empty() || edges.back().a != side.a || edges.back().b != side.b) {
            edges.push_back({side.a, side.b, std::uint32_t(topology.faces.size()), 0});
        }
        ++edges.back().faceCount;
        topology.faces.push_back(side.face);
    }
    return topology;
}

}  // namespace penumbra
