// SPDX-License-Identifier: Apache-2.0
#include "studio/metrics/flicker.h"

#include <algorithm>
#include <cmath>

#include "studio/errors.h"

namespace penumbra::studio {
namespace {

constexpr double poppingThreshold = 0.1;

bool sameShape(const Image& a, const Image& b) {
    return a.width_px == b.width_px && a.height_px == b.height_px && a.channels == b.channels;
}

}  // namespace

void FlickerMeter::add(const Image& truth, const Image& test, std::span<const std::uint8_t> mask) {
    const bool first = truth_.values.empty();
    if (!sameShape(truth, test) || mask.size() != truth.pixelCount() ||
        (!first && !sameShape(truth, truth_))) {
        throw InputError("flicker: all frames, truth and test and mask, must have one size");
    }
    if (!first) {
        for (std::size_t i = 0; i < truth.values.size(); ++i) {
            const std::size_t pixel = i / std::size_t(truth.channels);
            if (mask[pixel] == 0 || mask_[pixel] == 0) continue;
            const double beyond = std::max(0.0, std::abs(double(test.values[i]) - test_.values[i]) -
                                                    std::abs(double(truth.values[i]) - truth_.values[i]));
            squares_ += beyond * beyond;
            max_ = std::max(max_, beyond);
            if (beyond > poppingThreshold) ++popping_;
            ++samples_;
        }
    }
    truth_ = truth;
    test_ = test;
    mask_.assign(mask.begin(), mask.end());
}

FlickerMetrics FlickerMeter::result() const {
    if (samples_ == 0) return {};
    return {.rms = std::sqrt(squares_ / double(samples_)),
            .popping = double(popping_) / double(samples_),
            .max = max_,
            .samples = samples_};
}

}  // namespace penumbra::studio
