// SPDX-License-Identifier: Apache-2.0
#include "studio/metrics/flicker.h"

#include <gtest/gtest.h>

#include <cmath>

#include "studio/errors.h"

namespace penumbra::studio {
namespace {

constexpr int width = 4, height = 2;
const std::vector<std::uint8_t> everywhere(width* height, 1);

Image flat(float value) {
    return Image(width, height, 1, value);
}

/// Of frames (truth, test), each of one grey.
FlickerMetrics flickerOf(std::initializer_list<std::pair<float, float>> frames) {
    FlickerMeter meter;
    for (const auto& [truth, test] : frames) meter.add(flat(truth), flat(test), everywhere);
    return meter.result();
}

TEST(Flicker, AnErrorThatStandsStillIsNone) {
    EXPECT_EQ(flickerOf({{0.2f, 0.9f}, {0.2f, 0.9f}, {0.2f, 0.9f}}).rms, 0);
}

TEST(Flicker, ChangeThatTheTruthMakesIsNone) {
    EXPECT_EQ(flickerOf({{0, 0.25f}, {0.5f, 0.75f}}).rms, 0);
    EXPECT_EQ(flickerOf({{0, 0.5f}, {0.5f, 0}}).rms, 0) << "as much, if the other way";
}

TEST(Flicker, CountsWhatGoesBeyondTheTruth) {
    const FlickerMetrics metrics = flickerOf({{0, 0}, {0.25f, 0.75f}});
    EXPECT_DOUBLE_EQ(metrics.rms, 0.5);
    EXPECT_DOUBLE_EQ(metrics.max, 0.5);
    EXPECT_DOUBLE_EQ(metrics.popping, 1);
    EXPECT_EQ(metrics.samples, std::size_t(width * height));
}

TEST(Flicker, IsAMeanOverPairsOfFrames) {
    // One pair of two changes by 1: the root of a half.
    EXPECT_DOUBLE_EQ(flickerOf({{0, 0}, {0, 1}, {0, 1}}).rms, std::sqrt(0.5));
    EXPECT_DOUBLE_EQ(flickerOf({{0, 0}, {0, 1}, {0, 1}}).popping, 0.5);
}

TEST(Flicker, AShiverOfATenthIsNoPopping) {
    EXPECT_EQ(flickerOf({{0.5f, 0.5f}, {0.5f, 0.5625f}}).popping, 0);
}

TEST(Flicker, APixelCountsWhereTheLightArrivesInBothFrames) {
    std::vector<std::uint8_t> left(width * height, 0), right(width * height, 0);
    left[0] = left[1] = right[1] = right[2] = 1;
    FlickerMeter meter;
    meter.add(flat(0), flat(0), left);
    meter.add(flat(0), flat(1), right);
    EXPECT_EQ(meter.result().samples, 1u);
    EXPECT_EQ(meter.result().rms, 1);
}

TEST(Flicker, OneFrameHasNone) {
    EXPECT_EQ(flickerOf({{0, 1}}).samples, 0u);
    EXPECT_EQ(flickerOf({{0, 1}}).rms, 0);
}

TEST(Flicker, RefusesWhatDoesNotFit) {
    FlickerMeter meter;
    EXPECT_THROW(meter.add(flat(0), Image(width, 1, 1), everywhere), InputError);
    EXPECT_THROW(meter.add(flat(0), flat(0), std::vector<std::uint8_t>(3, 1)), InputError);
    meter.add(flat(0), flat(0), everywhere);
    EXPECT_THROW(meter.add(Image(1, 1, 1), Image(1, 1, 1), std::vector<std::uint8_t>(1, 1)), InputError);
}

}  // namespace
}  // namespace penumbra::studio
