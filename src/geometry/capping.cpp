// SPDX-License-Identifier: Apache-2.0
#include "src/geometry/capping.h"

#include <algorithm>
#include <memory>
#include <span>

#include "src/geometry/mesh_internals.h"

namespace penumbra {
namespace {

/// The edges that are walked more often in one direction than in the other, once for each time: sorted by
/// where they come from.
struct OpenWays {
    std::vector<std::uint32_t> first;  ///< for each vertex, and one more: its ways' place in `to`
    std::vector<std::uint32_t> to;
};

OpenWays openWays(const EdgeTopology& topology) {
    std::uint32_t vertexCount = 0;
    for (const EdgeTopology::Edge& edge : topology.edges) vertexCount = std::max(vertexCount, edge.b + 1);
    const auto forEachWay = [&](auto&& visit) {
        for (const EdgeTopology::Edge& edge : topology.edges) {
            int balance = 0;
            for (std::uint32_t i = 0; i < edge.faceCount; ++i)
                balance += (topology.faces[edge.firstFace + i] & 1) == 0 ? 1 : -1;
            for (; balance > 0; --balance) visit(edge.a, edge.b);
            for (; balance < 0; ++balance) visit(edge.b, edge.a);
        }
    };
    OpenWays ways;
    ways.first.assign(vertexCount + 1, 0);
    forEachWay([&](std::uint32_t from, std::uint32_t) { ++ways.first[from + 1]; });
    for (std::size_t i = 1; i < ways.first.size(); ++i) ways.first[i] += ways.first[i - 1];
    ways.to.resize(ways.first.back());
    std::vector<std::uint32_t> next(ways.first.begin(), ways.first.end() - 1);
    forEachWay([&](std::uint32_t from, std::uint32_t to) { ways.to[next[from]++] = to; });
    return ways;
}

}  // namespace

std::vector<std::uint32_t> capHoles(const EdgeTopology& topology) {
    // Every triangle enters each of its vertices as often as it leaves it, and so do the open ways: whoever
    // walks along them comes back to where they have been, and has then gone around a hole.
    const OpenWays ways = openWays(topology);
    constexpr std::uint32_t notOnPath = ~0u;
    std::vector<std::uint32_t> taken(ways.first.begin(), ways.first.end() - 1);
    std::vector<std::uint32_t> placeOnPath(taken.size(), notOnPath);
    std::vector<std::uint32_t> path, caps;
    for (std::uint32_t start = 0; start < taken.size(); ++start) {
        path.assign(1, start);
        placeOnPath[start] = 0;
        while (taken[path.back()] < ways.first[path.back() + 1]) {
            const std::uint32_t to = ways.to[taken[path.back()]++];
            if (placeOnPath[to] == notOnPath) {
                placeOnPath[to] = std::uint32_t(path.size());
                path.push_back(to);
                continue;
            }
            const std::span<const std::uint32_t> loop = std::span(path).subspan(placeOnPath[to]);
            // Two ways at a time are walked back, and replaced by a third, all from the loop's first vertex.
            for (std::size_t i = 1; i + 1 < loop.size(); ++i)
                caps.insert(caps.end(), {loop[0], loop[i + 1], loop[i]});
            for (const std::uint32_t vertex : loop.subspan(1)) placeOnPath[vertex] = notOnPath;
            path.resize(placeOnPath[to] + 1);
        }
        placeOnPath[start] = notOnPath;
    }
    return caps;
}

const Mesh& cappedOf(Device::Internals& device, const Mesh& mesh) {
    Mesh::Internals& internals = internalsOf(mesh);
    if (!internals.capped) {
        std::vector<std::uint32_t> indices = capHoles(findEdges(mesh.positions(), mesh.indices()));
        indices.insert(indices.begin(), mesh.indices().begin(), mesh.indices().end());
        internals.capped = std::make_unique<Mesh>(
            Mesh::Internals::make(device, {.positions = mesh.positions(), .indices = indices}));
        internals.cappedRevision = mesh.revision();
    }
    if (internals.capped->indices().size() == mesh.indices().size()) return mesh;
    if (internals.cappedRevision != mesh.revision()) {
        internalsOf(*internals.capped).deform(device, {.buffer = mesh.positionBuffer()}, mesh.bounds());
        internals.cappedRevision = mesh.revision();
    }
    return *internals.capped;
}

}  // namespace penumbra
