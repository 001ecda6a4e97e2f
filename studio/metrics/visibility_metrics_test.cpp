// SPDX-License-Identifier: Apache-2.0
#include "studio/metrics/visibility_metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "studio/errors.h"

namespace penumbra::studio {
namespace {

Image row(std::vector<float> values) {
    Image image(int(values.size()), 1, 1);
    image.values = std::move(values);
    return image;
}

Image noise(int width, int height, int channels, std::uint32_t seed) {
    Image image(width, height, channels);
    std::mt19937 random(seed);
    for (float& value : image.values) value = std::clamp(float(random()) / 3e9f - 0.2f, 0.0f, 1.0f);
    return image;
}

TEST(VisibilityMetrics, ByHand) {
    //                        umbra, umbra leaks, penumbra, penumbra, lit lost, lit
    const Image truth = row({0.0f, 0.002f, 0.5f, 0.25f, 1.0f, 0.998f});
    const Image test = row({0.0f, 0.252f, 0.25f, 0.25f, 0.75f, 0.998f});
    const VisibilityMetrics m = compareVisibility(truth, test);
    EXPECT_NEAR(m.rmse, std::sqrt(3 * 0.0625 / 6), 1e-7);
    EXPECT_NEAR(m.mae, 0.125, 1e-7);
    EXPECT_NEAR(m.penumbra_rmse, std::sqrt(0.0625 / 2), 1e-7);
    EXPECT_NEAR(m.p99, 0.25, 1e-7);
    EXPECT_NEAR(m.max, 0.25, 1e-7);
    EXPECT_DOUBLE_EQ(m.leak, 0.5);
    EXPECT_DOUBLE_EQ(m.false_shadow, 0.5);
    EXPECT_EQ(m.samples, 6u);
    EXPECT_EQ(m.penumbraSamples, 2u);
    EXPECT_EQ(m.umbraSamples, 2u);
    EXPECT_EQ(m.litSamples, 2u);
}

TEST(VisibilityMetrics, P99IsTheNearestRank) {
    Image truth(200, 1, 1), test(200, 1, 1);
    for (int x = 0; x < 200; ++x) test.at(x, 0) = float(199 - x) / 256;
    EXPECT_DOUBLE_EQ(compareVisibility(truth, test).p99, 197.0 / 256);  // 198 of 200 do not exceed it
    EXPECT_DOUBLE_EQ(compareVisibility(row({0}), row({0.5f})).p99, 0.5);
}

TEST(VisibilityMetrics, EqualImagesHaveNoError) {
    const Image image = noise(31, 17, 3, 1);
    const VisibilityMetrics m = compareVisibility(image, image);
    for (const double number : {m.rmse, m.mae, m.penumbra_rmse, m.p99, m.max, m.leak, m.false_shadow}) {
        EXPECT_EQ(number, 0);
    }
}

TEST(VisibilityMetrics, ErrorsAreSymmetricAndObeyTheTriangleInequality) {
    const Image a = noise(31, 17, 1, 1), b = noise(31, 17, 1, 2), c = noise(31, 17, 1, 3);
    const VisibilityMetrics ab = compareVisibility(a, b), ba = compareVisibility(b, a);
    EXPECT_EQ(ab.rmse, ba.rmse);
    EXPECT_EQ(ab.mae, ba.mae);
    EXPECT_EQ(ab.p99, ba.p99);
    EXPECT_EQ(ab.max, ba.max);
    EXPECT_LE(compareVisibility(a, c).rmse, ab.rmse + compareVisibility(b, c).rmse);
    EXPECT_LE(ab.mae, ab.rmse);
    EXPECT_LE(ab.rmse, ab.max);
    EXPECT_LE(ab.p99, ab.max);
}

TEST(VisibilityMetrics, TheNegativeImageSwapsLeaksAndFalseShadows) {
    const Image a = noise(31, 17, 1, 1), b = noise(31, 17, 1, 2);
    const auto negative = [](Image image) {
        for (float& value : image.values) value = 1 - value;
        return image;
    };
    const VisibilityMetrics m = compareVisibility(a, b), n = compareVisibility(negative(a), negative(b));
    EXPECT_GT(m.leak, 0);
    EXPECT_EQ(m.leak, n.false_shadow);
    EXPECT_EQ(m.false_shadow, n.leak);
    EXPECT_NEAR(m.penumbra_rmse, n.penumbra_rmse, 1e-7);
}

TEST(VisibilityMetrics, OnlyMaskedPixelsCount) {
    const Image truth = row({0, 0, 1, 1}), test = row({0, 1, 1, 0});
    const std::vector<std::uint8_t> mask{1, 0, 255, 0};
    const VisibilityMetrics m = compareVisibility(truth, test, mask);
    EXPECT_EQ(m.rmse, 0);
    EXPECT_EQ(m.leak, 0);
    EXPECT_EQ(m.samples, 2u);
    const VisibilityMetrics none = compareVisibility(truth, test, std::vector<std::uint8_t>(4, 0));
    EXPECT_EQ(none.samples, 0u);
    EXPECT_EQ(none.rmse, 0);
    EXPECT_EQ(none.p99, 0);
}

TEST(VisibilityMetrics, ChannelsAreSamples) {
    Image truth(2, 1, 3), test(2, 1, 3);
    test.values = {0.5f, 0, 0, 0, 0, 0};
    EXPECT_NEAR(compareVisibility(truth, test).rmse, std::sqrt(0.25 / 6), 1e-9);
    EXPECT_NEAR(compareVisibility(truth, test).leak, 1.0 / 6, 1e-9);
    EXPECT_NEAR(compareVisibility(truth, row({0.5f, 0})).mae, 0.25,
                1e-9);  // one channel against each of three
}

TEST(VisibilityMetrics, WhatIsNotFiniteFailsAndIsFound) {
    Image truth(3, 2, 1), test(3, 2, 1);
    test.at(2, 1) = std::numeric_limits<float>::quiet_NaN();
    truth.at(1, 1) = std::numeric_limits<float>::infinity();
    const VisibilityMetrics m = compareVisibility(truth, test, std::vector<std::uint8_t>(6, 0));
    EXPECT_EQ(m.notFinite, 2u);
    ASSERT_TRUE(m.firstNotFinite);
    EXPECT_EQ(m.firstNotFinite->x, 1);
    EXPECT_EQ(m.firstNotFinite->y, 1);
    EXPECT_TRUE(std::isnan(m.rmse) && std::isnan(m.max) && std::isnan(m.leak));
}

TEST(VisibilityMetrics, RefusesWhatDoesNotFit) {
    EXPECT_THROW(compareVisibility(Image(2, 2, 1), Image(2, 1, 1)), InputError);
    EXPECT_THROW(compareVisibility(Image(2, 2, 1), Image(2, 2, 3)), InputError);
    EXPECT_THROW(compareVisibility(Image(2, 2, 1), Image(2, 2, 1), std::vector<std::uint8_t>(3)), InputError);
    EXPECT_EQ(compareVisibility(Image(), Image()).samples, 0u);
}

TEST(VisibilityMetrics, DarkInTheTruthAloneIsWhatNoTestAgreesWith) {
    const Image truth = row({0.0f, 0.05f, 0.0f, 0.5f, 1.0f});
    const std::vector<Image> tests{row({1.0f, 0.95f, 1.0f, 1.0f, 1.0f}), row({1.0f, 1.0f, 0.3f, 1.0f, 1.0f})};
    EXPECT_DOUBLE_EQ(shareDarkInTruthAlone(truth, tests), 0.4);
    EXPECT_DOUBLE_EQ(shareDarkInTruthAlone(truth, std::span(tests).first(1)), 0.6);
    EXPECT_DOUBLE_EQ(shareDarkInTruthAlone(truth, {}), 0);
    const std::vector<std::uint8_t> mask{1, 0, 0, 0, 1};
    EXPECT_DOUBLE_EQ(shareDarkInTruthAlone(truth, tests, mask), 0.5);
    EXPECT_THROW(shareDarkInTruthAlone(row({0}), tests), InputError);
}

}  // namespace
}  // namespace penumbra::studio
