// SPDX-License-Identifier: Apache-2.0
// How far a visibility buffer is from the truth: the numbers of `compare --json`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "studio/image/image.h"

namespace penumbra::studio {

/// Errors in units of visibility, 0 to 1. The channels of coloured visibility count as samples of their own:
/// each number is what an image with three times as many grey pixels would give.
struct VisibilityMetrics {
    double rmse = 0;           ///< root of the mean squared error
    double mae = 0;            ///< mean absolute error
    double penumbra_rmse = 0;  ///< rmse where 0.01 < truth < 0.99
    double p99 = 0;            ///< the least error that 99 of 100 samples do not exceed
    double max = 0;            ///< largest absolute error
    double leak = 0;           ///< share of umbra samples (truth <= 0.002) that got more than 0.1
    double false_shadow = 0;   ///< share of lit samples (truth >= 0.998) that lost more than 0.1

    std::size_t samples = 0;          ///< masked pixels times channels; with none, the numbers above are 0
    std::size_t penumbraSamples = 0;  ///< with none, penumbra_rmse is 0
    std::size_t umbraSamples = 0;     ///< with none, leak is 0
    std::size_t litSamples = 0;       ///< with none, false_shadow is 0

    struct Pixel {
        int x = 0, y = 0;
    };
    /// Values that are NaN or infinite, in either image, masked or not. If there are any, all numbers above
    /// the counts are NaN and the comparison has failed.
    std::size_t notFinite = 0;
    std::optional<Pixel> firstNotFinite;  ///< the topmost, leftmost
};

/// Compares over the pixels where `mask` is not 0: those that the unshadowed light reaches. An empty mask
/// means all. `test` may have one channel where `truth` has three: it is then compared with each. Throws
/// InputError if sizes or channels do not fit.
VisibilityMetrics compareVisibility(const Image& truth, const Image& test,
                                    std::span<const std::uint8_t> mask = {});

/// The share of masked samples that are dark in the truth (<= 0.1) and lit in every test (>= 0.9): where
/// several tests err alike, or the truth does. 0 without tests. Sizes, channels and mask as above.
double shareDarkInTruthAlone(const Image& truth, std::span<const Image> tests,
                             std::span<const std::uint8_t> mask = {});

}  // namespace penumbra::studio
