// SPDX-License-Identifier: Apache-2.0
#include "studio/metrics/visibility_metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "studio/errors.h"

namespace penumbra::studio {
namespace {

void checkSizes(const Image& truth, const Image& test, std::span<const std::uint8_t> mask) {
    if (truth.width_px != test.width_px || truth.height_px != test.height_px ||
        (truth.channels != test.channels && test.channels != 1)) {
        throw InputError(fmt::format(
            "cannot compare {} x {} x {} values with {} x {} x {}; render both at one size", truth.width_px,
            truth.height_px, truth.channels, test.width_px, test.height_px, test.channels));
    }
    if (!mask.empty() && mask.size() != truth.pixelCount()) {
        throw InputError(
            fmt::format("the mask has {} pixels, the images have {}", mask.size(), truth.pixelCount()));
    }
}

/// A mean that is 0 where there is nothing.
double meanOf(double sum, std::size_t count) {
    return count > 0 ? sum / double(count) : 0;
}

/// Nearest rank: the least of the errors that `share` of them do not exceed.
double percentile(std::vector<float>& errors, double share) {
    if (errors.empty()) return 0;
    const auto rank = std::size_t(std::ceil(share * double(errors.size())));
    const auto place = errors.begin() + std::ptrdiff_t(std::max<std::size_t>(rank, 1) - 1);
    std::ranges::nth_element(errors, place);
    return *place;
}

}  // namespace

VisibilityMetrics compareVisibility(const Image& truth, const Image& test,
                                    std::span<const std::uint8_t> mask) {
    checkSizes(truth, test, mask);
    VisibilityMetrics metrics;
    double squares = 0, sum = 0, penumbraSquares = 0;
    std::size_t leaks = 0, falseShadows = 0;
    std::vector<float> errors;
    errors.reserve(truth.values.size());

    for (std::size_t pixel = 0; pixel < truth.pixelCount(); ++pixel) {
        for (int c = 0; c < truth.channels; ++c) {
            const float expected = truth.values[pixel * truth.channels + c];
            const float actual = test.values[pixel * test.channels + (test.channels == 1 ? 0 : c)];
            if (!std::isfinite(expected) || !std::isfinite(actual)) {
                if (metrics.notFinite++ == 0) {
                    metrics.firstNotFinite = {{int(pixel % truth.width_px), int(pixel / truth.width_px)}};
                }
                continue;
            }
            if (!mask.empty() && mask[pixel] == 0) continue;

            const double error = std::abs(double(actual) - expected);
            errors.push_back(float(error));
            sum += error;
            squares += error * error;
            metrics.max = std::max(metrics.max, error);
            if (expected > 0.01f && expected < 0.99f) {
                ++metrics.penumbraSamples;
                penumbraSquares += error * error;
            }
            if (expected <= 0.002f) {
                ++metrics.umbraSamples;
                leaks += actual > 0.1f;
            }
            if (expected >= 0.998f) {
                ++metrics.litSamples;
                falseShadows += actual < 0.9f;
            }
        }
    }
    metrics.samples = errors.size();
    metrics.rmse = std::sqrt(meanOf(squares, metrics.samples));
    metrics.mae = meanOf(sum, metrics.samples);
    metrics.penumbra_rmse = std::sqrt(meanOf(penumbraSquares, metrics.penumbraSamples));
    metrics.p99 = percentile(errors, 0.99);
    metrics.leak = meanOf(double(leaks), metrics.umbraSamples);
    metrics.false_shadow = meanOf(double(falseShadows), metrics.litSamples);
    if (metrics.notFinite > 0) {
        for (double* number : {&metrics.rmse, &metrics.mae, &metrics.penumbra_rmse, &metrics.p99,
                               &metrics.max, &metrics.leak, &metrics.false_shadow}) {
            *number = std::numeric_limits<double>::quiet_NaN();
        }
    }
    return metrics;
}

double shareDarkInTruthAlone(const Image& truth, std::span<const Image> tests,
                             std::span<const std::uint8_t> mask) {
    for (const Image& test : tests) checkSizes(truth, test, mask);
    std::size_t samples = 0, alone = 0;
    for (std::size_t pixel = 0; pixel < truth.pixelCount(); ++pixel) {
        if (!mask.empty() && mask[pixel] == 0) continue;
        for (int c = 0; c < truth.channels; ++c) {
            ++samples;
            alone += truth.values[pixel * truth.channels + c] <= 0.1f &&
                     std::ranges::all_of(tests, [&](const Image& test) {
                         return test.values[pixel * test.channels + (test.channels == 1 ? 0 : c)] >= 0.9f;
                     });
        }
    }
    return tests.empty() ? 0 : meanOf(double(alone), samples);
}

}  // namespace penumbra::studio
