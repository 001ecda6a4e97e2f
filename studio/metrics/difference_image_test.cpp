// SPDX-License-Identifier: Apache-2.0
#include "studio/metrics/difference_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "studio/errors.h"

namespace penumbra::studio {
namespace {

/// CIE L*.
double lightness(const std::array<float, 3>& srgb) {
    const auto linear = [](double v) { return v > 0.04045 ? std::pow((v + 0.055) / 1.055, 2.4) : v / 12.92; };
    return 116 * std::cbrt(0.2126 * linear(srgb[0]) + 0.7152 * linear(srgb[1]) + 0.0722 * linear(srgb[2])) -
           16;
}

TEST(DivergingColor, RedIsMoreBlueIsLess) {
    EXPECT_GT(divergingColor(0.5f)[0], divergingColor(0.5f)[2]);
    EXPECT_LT(divergingColor(-0.5f)[0], divergingColor(-0.5f)[2]);
    EXPECT_EQ(divergingColor(0), divergingColor(-0.0f));
    EXPECT_EQ(divergingColor(1), divergingColor(9));
    EXPECT_EQ(divergingColor(std::numeric_limits<float>::quiet_NaN()), (std::array<float, 3>{1, 0, 1}));
    EXPECT_EQ(divergingColor(-std::numeric_limits<float>::infinity()), divergingColor(-1));
}

TEST(DivergingColor, DarkensEvenlyOnBothSides) {
    double before = 101;
    for (float value = 0; value <= 1; value += 0.05f) {
        const double more = lightness(divergingColor(value)), less = lightness(divergingColor(-value));
        EXPECT_NEAR(more, less, 3) << value;
        EXPECT_LT(more, before);
        before = more;
    }
}

TEST(DifferenceImage, ShowsFiveTimesTheSignedDifference) {
    Image truth(3, 1, 1, 0.5f), test = truth;
    test.values = {0.5f, 0.6f, 0.25f};
    const Image image = differenceImage(truth, test);
    const auto colorAt = [&](int x) {
        return std::array{image.at(x, 0, 0), image.at(x, 0, 1), image.at(x, 0, 2)};
    };
    EXPECT_EQ(colorAt(0), divergingColor(0));
    EXPECT_NEAR(colorAt(1)[1], divergingColor(0.5f)[1], 1e-6);
    EXPECT_EQ(colorAt(2), divergingColor(-1));
    EXPECT_THROW(differenceImage(truth, Image(2, 1, 1)), InputError);
}

}  // namespace
}  // namespace penumbra::studio
