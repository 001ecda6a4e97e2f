// SPDX-License-Identifier: Apache-2.0
#include "studio/metrics/difference_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studio/errors.h"

namespace penumbra::studio {
namespace {

using Color = std::array<float, 3>;

// Seen from white, each side goes through a light and a full tone to a dark one. The two sides have the same
// lightness (CIE L* of about 97, 72, 48, 25), step by step.
constexpr std::array<Color, 4> towardsBlue{
    {{0.97f, 0.97f, 0.97f}, {0.50f, 0.72f, 0.87f}, {0.16f, 0.46f, 0.72f}, {0.03f, 0.23f, 0.42f}}};
constexpr std::array<Color, 4> towardsRed{
    {{0.97f, 0.97f, 0.97f}, {0.97f, 0.63f, 0.50f}, {0.81f, 0.26f, 0.24f}, {0.44f, 0.04f, 0.12f}}};

}  // namespace

Color divergingColor(float value) {
    if (std::isnan(value)) return {1, 0, 1};
    const std::array<Color, 4>& tones = value < 0 ? towardsBlue : towardsRed;
    const float place = std::min(std::abs(value), 1.0f) * 3;
    const int below = std::min(int(place), 2);
    Color color;
    for (std::size_t c = 0; c < 3; ++c) {
        color[c] =
            std::lerp(tones[std::size_t(below)][c], tones[std::size_t(below) + 1][c], place - float(below));
    }
    return color;
}

Image differenceImage(const Image& truth, const Image& test, float gain) {
    if (truth.width_px != test.width_px || truth.height_px != test.height_px ||
        (truth.channels != test.channels && test.channels != 1)) {
        throw InputError(fmt::format(
            "cannot compare {} x {} x {} values with {} x {} x {}; render both at one size", truth.width_px,
            truth.height_px, truth.channels, test.width_px, test.height_px, test.channels));
    }
    Image image(truth.width_px, truth.height_px, 3);
    for (std::size_t pixel = 0; pixel < truth.pixelCount(); ++pixel) {
        float difference = 0;
        for (int c = 0; c < truth.channels; ++c) {
            const float actual = test.values[pixel * test.channels + (test.channels == 1 ? 0 : c)];
            difference += (actual - truth.values[pixel * truth.channels + c]) / float(truth.channels);
        }
        std::ranges::copy(divergingColor(gain * difference),
                          image.values.begin() + std::ptrdiff_t(3 * pixel));
    }
    return image;
}

}  // namespace penumbra::studio
