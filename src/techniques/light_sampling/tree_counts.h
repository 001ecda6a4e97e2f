// SPDX-License-Identifier: Apache-2.0
// What a subdivision of the light came to, for Technique::statistics.
#pragma once

#include <array>
#include <vector>

#include "penumbra/technique.h"
#include "src/techniques/light_sampling/subdivision_io.h"

namespace penumbra::light_sampling {

struct TreeCounts {
    double slots = 0;                                ///< maps over those of a sample
    std::array<double, deepestLevel + 1> samples{};  ///< that a level brought
    std::array<double, deepestLevel> split{};        ///< quads of a level
    std::array<double, deepestLevel> failing{};      ///< fragments, over all quads of a level
    bool reachedMaximum = false;

    static TreeCounts of(const Subdivision& tree, int slots);
    /// Names the numbers. `faces`: maps a sample.
    std::vector<Statistic> statistics(int faces) const;
};

}  // namespace penumbra::light_sampling
