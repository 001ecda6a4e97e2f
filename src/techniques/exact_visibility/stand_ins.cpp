// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/exact_visibility/stand_ins.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "src/device/glm_types.h"
#include "src/techniques/exact_visibility/patch_simplifier.h"

namespace penumbra::exact_visibility {
namespace {

/// Triangles below the lowest stand-ins at least, and how many times as many below the next ones.
constexpr std::uint32_t leastBelow = 256, stepBelow = 4;
/// A stand-in that has more of what it is made from is no gain.
constexpr double largestShare = 0.5;
/// Of its node's size: what deviates more is of use only where the node is a dot.
constexpr float largestDeviation = 1 / 256.0f;

/// How many steps of size a node is above the lowest stand-ins; 0 below them.
int stepOf(std::uint32_t triangles) {
    int step = 0;
    for (std::uint64_t least = leastBelow; triangles >= least; least *= stepBelow) ++step;
    return step;
}

/// For each vertex the first one that lies where it does.
std::vector<std::uint32_t> weld(std::span<const Vec3> positions) {
    std::vector<std::uint32_t> order(positions.size()), first(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t i) {
        return std::tuple(positions[i].x, positions[i].y, positions[i].z, i);
    };
    std::ranges::sort(order, {}, key);
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool isSame = i > 0 && toGlm(positions[order[i]]) == toGlm(positions[order[i - 1]]);
        first[order[i]] = isSame ? first[order[i - 1]] : order[i];
    }
    return first;
}

}  // namespace

StandIns makeStandIns(const TreeShape& shape, std::span<const Vec3> positions,
                      std::span<const std::uint32_t> indices) {
    const std::vector<std::uint32_t> welded = weld(positions);
    std::vector<glm::vec3> at(positions.size());
    std::ranges::transform(positions, at.begin(), [](const Vec3& p) { return toGlm(p); });
    PatchSimplifier simplifier(at);

    const std::vector<TreeShape::Node>& nodes = shape.nodes;
    std::vector<std::uint32_t> below(nodes.size());
    std::vector<std::uint32_t> standInOf(nodes.size(), 0);  // its place in the list, plus 1
    StandIns result;
    std::vector<Triangle> patch;
    // Children stand behind their parents.
    for (std::size_t i = nodes.size(); i-- > 0;) {
        const TreeShape::Node& node = nodes[i];
        below[i] = node.count > 0 ? node.count : below[i + 1] + below[nodes[i + 1].skip];
        if (node.count > 0) continue;
        if (stepOf(below[i]) <= std::max(stepOf(below[i + 1]), stepOf(below[nodes[i + 1].skip]))) continue;

        patch.clear();
        TreeBox box;
        float deviation = 0;
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            patch.push_back({a, b, c});
            for (const std::uint32_t vertex : patch.back()) box.add(at[vertex]);
        };
        for (std::size_t k = i + 1; k < node.skip;) {
            if (standInOf[k] > 0) {
                const StandIn& part = result.list[standInOf[k] - 1];
                deviation = std::max(deviation, part.deviation);
                for (std::size_t t = part.first; t < part.first + part.count; ++t)
                    add(result.indices[3 * t], result.indices[3 * t + 1], result.indices[3 * t + 2]);
                k = nodes[k].skip;
                continue;
            }
            for (std::size_t place = nodes[k].first; place < nodes[k].first + nodes[k].count; ++place) {
                const std::size_t corner = 3 * std::size_t(shape.order[place]);
                add(welded[indices[corner]], welded[indices[corner + 1]], welded[indices[corner + 2]]);
            }
            ++k;
        }
        const float limit = largestDeviation * glm::distance(box.min, box.max) - deviation;
        const PatchSimplifier::Result coarse = simplifier.simplify(patch, limit);
        if (double(coarse.triangles.size()) > largestShare * double(patch.size()) || coarse.triangles.empty())
            continue;
        standInOf[i] = std::uint32_t(result.list.size()) + 1;
        result.list.push_back({.node = std::uint32_t(i),
                               .deviation = deviation + coarse.deviation,
                               .first = result.indices.size() / 3,
                               .count = coarse.triangles.size()});
        for (const Triangle& triangle : coarse.triangles)
            result.indices.insert(result.indices.end(), triangle.begin(), triangle.end());
    }
    std::ranges::sort(result.list, {}, &StandIn::node);
    return result;
}

}  // namespace penumbra::exact_visibility
