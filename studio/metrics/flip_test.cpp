// SPDX-License-Identifier: Apache-2.0
#include "studio/metrics/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "studio/errors.h"

namespace penumbra::studio {
namespace {

constexpr double pi = std::numbers::pi;

Image uniform(float r, float g, float b, int width = 24, int height = 16) {
    Image image(width, height, 3);
    for (std::size_t i = 0; i < image.values.size(); i += 3) {
        image.values[i] = r;
        image.values[i + 1] = g;
        image.values[i + 2] = b;
    }
    return image;
}

Image noise(int width, int height, std::uint32_t seed) {
    Image image(width, height, 3);
    std::mt19937 random(seed);
    for (float& value : image.values) value = float(random() >> 8) * 0x1p-24f;
    return image;
}

// FLIP once more, as the paper writes it: in doubles, every filter in two dimensions, one pixel at a time.
// Shares no code with what it checks.
class SlowFlip {
  public:
    SlowFlip(const Image& reference, const Image& test, double ppd) : ppd_(ppd), images_{&reference, &test} {}

    double at(int x, int y) const {
        const std::array<Vec, 2> lab{lookedAt(*images_[0], x, y), lookedAt(*images_[1], x, y)};
        const double q = 0.7;
        const double most = std::pow(hyab(hunt({0, 1, 0}), hunt({0, 0, 1})), q);
        const double power = std::pow(hyab(lab[0], lab[1]), q);
        const double color = power < 0.4 * most ? 0.95 / (0.4 * most) * power
                                                : 0.95 + (power - 0.4 * most) / (0.6 * most) * 0.05;
        const double edges = std::abs(feature(*images_[0], x, y, false) - feature(*images_[1], x, y, false));
        const double points = std::abs(feature(*images_[0], x, y, true) - feature(*images_[1], x, y, true));
        return std::pow(color, 1 - std::sqrt(std::max(edges, points) / std::sqrt(2.0)));
    }

  private:
    using Vec = std::array<double, 3>;

    static Vec xyz(const Vec& rgb) {
        return {0.4123865632529917 * rgb[0] + 0.35759149092062537 * rgb[1] + 0.18045049120356368 * rgb[2],
                0.21263682167732384 * rgb[0] + 0.7151829818412507 * rgb[1] + 0.07218019648142547 * rgb[2],
                0.019330620152483987 * rgb[0] + 0.11919716364020845 * rgb[1] + 0.9503725870054354 * rgb[2]};
    }
    static Vec relative(const Vec& rgb) {
        const Vec v = xyz(rgb), white = xyz({1, 1, 1});
        return {v[0] / white[0], v[1] / white[1], v[2] / white[2]};
    }
    static Vec rgbOf(const Vec& relativeXyz) {
        const Vec white = xyz({1, 1, 1});
        const Vec v{relativeXyz[0] * white[0], relativeXyz[1] * white[1], relativeXyz[2] * white[2]};
        return {3.241003275 * v[0] - 1.537398934 * v[1] - 0.498615861 * v[2],
                -0.969224334 * v[0] + 1.875930071 * v[1] + 0.041554224 * v[2],
                0.055639423 * v[0] - 0.204011202 * v[1] + 1.057148933 * v[2]};
    }
    static Vec hunt(const Vec& rgb) {
        const Vec v = relative(rgb);
        const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : t * 841 / 108 + 4.0 / 29; };
        const double L = 116 * f(v[1]) - 16;
        return {L, L / 100 * 500 * (f(v[0]) - f(v[1])), L / 100 * 200 * (f(v[1]) - f(v[2]))};
    }
    static double hyab(const Vec& a, const Vec& b) {
        return std::abs(a[0] - b[0]) + std::sqrt(std::pow(a[1] - b[1], 2) + std::pow(a[2] - b[2], 2));
    }
    static Vec opponent(const Image& image, int x, int y) {
        x = std::clamp(x, 0, image.width_px - 1);
        y = std::clamp(y, 0, image.height_px - 1);
        Vec rgb;
        for (int c = 0; c < 3; ++c) {
            const double v = image.at(x, y, c);
            rgb[std::size_t(c)] = v > 0.04045 ? std::pow((v + 0.055) / 1.055, 2.4) : v / 12.92;
        }
        const Vec v = relative(rgb);
        return {116 * v[1] - 16, 500 * (v[0] - v[1]), 200 * (v[1] - v[2])};
    }
    Vec lookedAt(const Image& image, int x, int y) const {
        const int radius = int(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * ppd_));
        Vec sum{}, weights{};
        for (int j = -radius; j <= radius; ++j) {
            for (int i = -radius; i <= radius; ++i) {
                const double z = (i * i + j * j) / (ppd_ * ppd_);
                const auto gaussian = [&](double a, double b) {
                    return a * std::sqrt(pi / b) * std::exp(-pi * pi * z / b);
                };
                const Vec w{gaussian(1, 0.0047), gaussian(1, 0.0053),
                            gaussian(34.1, 0.04) + gaussian(13.5, 0.025)};
                const Vec color = opponent(image, x + i, y + j);
                for (std::size_t c = 0; c < 3; ++c) {
                    sum[c] += w[c] * color[c];
                    weights[c] += w[c];
                }
            }
        }
        const double Y = (sum[0] / weights[0] + 16) / 116;
        Vec rgb = rgbOf({Y + sum[1] / weights[1] / 500, Y, Y - sum[2] / weights[2] / 200});
        for (double& value : rgb) value = std::clamp(value, 0.0, 1.0);
        return hunt(rgb);
    }
    double feature(const Image& image, int x, int y, bool point) const {
        const double s = 0.5 * 0.082 * ppd_;
        const int radius = int(std::ceil(3 * s));
        std::array<double, 2> positive{},
            negative{};  // sums of the response, for the filter along x and along y
        double positiveWeights = 0, negativeWeights = 0;
        for (int j = -radius; j <= radius; ++j) {
            for (int i = -radius; i <= radius; ++i) {
                const double g = std::exp(-(i * i + j * j) / (2 * s * s));
                const double w = point ? (i * i / (s * s) - 1) * g : -i * g;
                (w > 0 ? positiveWeights : negativeWeights) += std::abs(w);
                auto& sums = w > 0 ? positive : negative;
                sums[0] += w * (opponent(image, x + i, y + j)[0] + 16) / 116;
                sums[1] += w * (opponent(image, x + j, y + i)[0] + 16) / 116;
            }
        }
        const double alongX = positive[0] / positiveWeights + negative[0] / negativeWeights;
        const double alongY = positive[1] / positiveWeights + negative[1] / negativeWeights;
        return std::sqrt(alongX * alongX + alongY * alongY);
    }

    double ppd_;
    std::array<const Image*, 2> images_;
};

TEST(Flip, EqualPicturesHaveNoDifference) {
    const Image image = noise(40, 30, 1);
    for (const float value : flipMap(image, image).values) ASSERT_EQ(value, 0);
}

TEST(Flip, IsSymmetricAndInRange) {
    const Image a = noise(40, 30, 1), b = noise(40, 30, 2);
    EXPECT_EQ(flipMap(a, b).values, flipMap(b, a).values);
    for (const float value : flipMap(a, b).values) {
        ASSERT_GT(value, 0);
        ASSERT_LE(value, 1);
    }
}

TEST(Flip, BlackAgainstWhite) {
    // L* differs by 100, colour not at all. Green and blue in Hunt-adjusted L*a*b* differ by 203.3: 100^0.7
    // = 25.119 lies above 0.4 of 203.3^0.7 = 41.27, hence 0.95 + 0.05 (25.119 - 16.51) / (0.6 * 41.27) =
    // 0.9674.
    EXPECT_NEAR(flip(uniform(0, 0, 0), uniform(1, 1, 1)), 0.9674, 1e-4);
}

TEST(Flip, GreenAgainstBlueIsTheMost) {
    EXPECT_NEAR(flip(uniform(0, 1, 0), uniform(0, 0, 1)), 1, 1e-5);
}

TEST(Flip, UniformGreys) {
    // sRGB 119 and 128 of 255 are linear 0.184475 and 0.215861, L* 50.034 and 53.585. 3.551^0.7 = 2.4281,
    // which is below the knee: 0.95 / 16.508 * 2.4281 = 0.1397.
    const float a = 119 / 255.0f, b = 128 / 255.0f;
    EXPECT_NEAR(flip(uniform(a, a, a), uniform(b, b, b)), 0.1397, 2e-4);
    EXPECT_NEAR(flip(Image(9, 9, 1, a), Image(9, 9, 1, b)), 0.1397, 2e-4);
}

TEST(Flip, AgreesWithASlowOneInDoubles) {
    Image a = noise(30, 26, 3), b = a;
    for (int y = 8; y < 20; ++y) {
        for (int x = 10; x < 30; ++x) {
            for (int c = 0; c < 3; ++c) b.at(x, y, c) = x < 20 ? 0.2f * float(c) : a.at(29 - x, y, c);
        }
    }
    for (const float ppd : {20.0f, defaultPixelsPerDegree}) {
        const Image map = flipMap(a, b, ppd);
        const SlowFlip slow(a, b, ppd);
        for (const auto& [x, y] :
             {std::array{0, 0}, {9, 7}, {10, 8}, {15, 14}, {19, 19}, {20, 12}, {29, 25}, {29, 0}}) {
            EXPECT_NEAR(map.at(x, y), slow.at(x, y), 2e-4) << x << ", " << y << " at " << ppd;
        }
    }
}

TEST(Flip, AFineCheckerIsLessVisibleFromAfar) {
    Image checker(64, 64, 3, 0.4f);
    for (int y = 0; y < 64; ++y) {
        for (int x = y % 2; x < 64; x += 2) {
            for (int c = 0; c < 3; ++c) checker.at(x, y, c) = 0.6f;
        }
    }
    const Image grey = uniform(0.51f, 0.51f, 0.51f, 64, 64);
    EXPECT_LT(flip(grey, checker, 120), 0.5 * flip(grey, checker, 10));
}

TEST(Flip, ANaNIsNotHidden) {
    Image bad = uniform(0, 0, 0);
    bad.at(3, 3, 1) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(std::isnan(flip(uniform(0, 0, 0), bad)));
}

TEST(Flip, RefusesWhatDoesNotFit) {
    EXPECT_THROW(flip(Image(4, 4, 3), Image(4, 5, 3)), InputError);
    EXPECT_THROW(flip(Image(4, 4, 3), Image(4, 4, 3), 0), InputError);
    EXPECT_THROW(flip(Image(4, 4, 3), Image(4, 4, 3), std::numeric_limits<float>::quiet_NaN()), InputError);
    EXPECT_EQ(flip(Image(0, 0, 3), Image(0, 0, 3)), 0);
    EXPECT_EQ(flipMap(Image(1, 1, 3), Image(1, 1, 3)).pixelCount(), 1u);
}

}  // namespace
}  // namespace penumbra::studio
