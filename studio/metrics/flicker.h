// SPDX-License-Identifier: Apache-2.0
// How much a technique's visibility changes from frame to frame beyond what the truth does: edges that crawl,
// shadows that pop.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "studio/image/image.h"

namespace penumbra::studio {

/// Of |test change| - |truth change| where that is positive, over pixels and pairs of consecutive frames. An
/// error that stands still counts nothing, nor does a change that the truth makes, too. Noise of the truth
/// makes all of it a little smaller, never larger.
struct FlickerMetrics {
    double rms = 0;
    double popping = 0;  ///< share of samples whose change exceeds the truth's by more than 0.1
    double max = 0;
    std::size_t samples = 0;  ///< with none, the numbers above are 0
};

/// Takes frame after frame of an animation.
class FlickerMeter {
  public:
    /// Images of one size and one number of channels throughout; `mask` is not 0 where the unshadowed light
    /// arrives, and a pixel counts where it does in both frames of a pair. Values must be finite. Throws
    /// InputError if sizes or channels do not fit.
    void add(const Image& truth, const Image& test, std::span<const std::uint8_t> mask);

    FlickerMetrics result() const;

  private:
    Image truth_, test_;
    std::vector<std::uint8_t> mask_;
    double squares_ = 0, max_ = 0;
    std::size_t popping_ = 0, samples_ = 0;
};

}  // namespace penumbra::studio
