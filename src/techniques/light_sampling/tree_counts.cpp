// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/light_sampling/tree_counts.h"

#include <numeric>

namespace penumbra::light_sampling {
namespace {

constexpr std::array<const char*, deepestLevel + 1> sampleNames = {"samples of level 0", "samples of level 1",
                                                                   "samples of level 2", "samples of level 3",
                                                                   "samples of level 4"};
constexpr std::array<const char*, deepestLevel> splitNames = {
    "quads split at level 0", "quads split at level 1", "quads split at level 2", "quads split at level 3"};
constexpr std::array<const char*, deepestLevel> failingNames = {
    "failing fragments of level 0", "failing fragments of level 1", "failing fragments of level 2",
    "failing fragments of level 3"};

}  // namespace

TreeCounts TreeCounts::of(const Subdivision& tree, int slots) {
    TreeCounts counts{.slots = double(slots), .reachedMaximum = tree.reachedMaximum != 0};
    std::size_t quad = 0;
    for (std::size_t level = 0; level < deepestLevel; ++level) {
        for (std::size_t end = quad + (std::size_t(1) << (2 * level)); quad < end; ++quad) {
            counts.split[level] += tree.split[quad];
            counts.failing[level] += tree.failing[quad];
        }
    }
    for (std::size_t level = 0; level <= deepestLevel; ++level)
        counts.samples[level] = tree.samplesOfLevel[level];
    return counts;
}

std::vector<Statistic> TreeCounts::statistics(int faces) const {
    std::vector<Statistic> named = {{"maps", slots * faces},
                                    {"samples", std::accumulate(samples.begin(), samples.end(), 0.0)},
                                    {"reached the maximum", double(reachedMaximum)}};
    for (std::size_t level = 0; level <= deepestLevel; ++level) {
        named.push_back({sampleNames[level], samples[level]});
        if (level == deepestLevel) break;
        named.push_back({splitNames[level], split[level]});
        named.push_back({failingNames[level], failing[level], "fragments"});
    }
    return named;
}

}  // namespace penumbra::light_sampling
