// SPDX-License-Identifier: Apache-2.0
// For tests: pixels that are wrong by themselves, which the eye finds at once and no mean error shows.
#pragma once

#include <algorithm>
#include <cmath>

#include "studio/workbench/workbench.h"

namespace penumbra::studio {

/// Pixels that are off by more than 0.2 while most of those around them are right. Where a second opinion is
/// given, it counts as well: at terminators rounding decides for the truth, too.
inline int wrongSinglePixels(const LightResult& truth, const LightResult& result,
                             const LightResult* second = nullptr) {
    const int width = truth.visibility.width_px, height = truth.visibility.height_px;
    const auto error = [&](int x, int y) {
        const std::size_t i = std::size_t(y) * std::size_t(width) + std::size_t(x);
        if (!(truth.reach.values[i] > 0)) return 0.0;
        const auto offFrom = [&](const LightResult& other) {
            return std::abs(double(result.visibility.values[i]) - double(other.visibility.values[i]));
        };
        return second ? std::min(offFrom(truth), offFrom(*second)) : offFrom(truth);
    };
    int wrong = 0;
    for (int y = 1; y + 1 < height; ++y) {
        for (int x = 1; x + 1 < width; ++x) {
            if (error(x, y) <= 0.2) continue;
            int right = 0;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) right += error(x + dx, y + dy) <= 0.1;
            wrong += right >= 5;
        }
    }
    return wrong;
}

}  // namespace penumbra::studio
