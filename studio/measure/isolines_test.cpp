// SPDX-License-Identifier: Apache-2.0
#include "studio/measure/isolines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace penumbra::studio {
namespace {

ValueGrid gridOf(int columns, int rows, double (*value)(double, double)) {
    ValueGrid grid{columns, rows, {}};
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) grid.values.push_back(value(column, row));
    }
    return grid;
}

TEST(Isolines, OfARampAreStraight) {
    const std::vector<Isoline> lines = isolinesOf(gridOf(10, 6, [](double x, double) { return x; }), 3.25);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].places.size(), 6u);
    for (const glm::dvec2& place : lines[0].places) EXPECT_DOUBLE_EQ(place.x, 3.25);
}

TEST(Isolines, AroundAHillCloseAndLieOnIt) {
    const auto hill = [](double x, double y) { return -std::hypot(x - 20, y - 20); };
    const std::vector<Isoline> lines = isolinesOf(gridOf(41, 41, hill), -10.5);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].places.front(), lines[0].places.back());
    for (const glm::dvec2& place : lines[0].places) EXPECT_NEAR(hill(place.x, place.y), -10.5, 0.02);
}

TEST(Isolines, OfASaddleAreTwo) {
    EXPECT_EQ(isolinesOf({2, 2, {1, 0, 0, 1}}, 0.5).size(), 2u);
    EXPECT_EQ(isolinesOf({2, 2, {1, 0, 0, 1}}, 0.4).size(), 2u);
}

TEST(Isolines, LeaveOutWhatHasNoValue) {
    EXPECT_TRUE(isolinesOf({2, 2, {0, 1, std::numeric_limits<double>::quiet_NaN(), 1}}, 0.5).empty());
    EXPECT_TRUE(isolinesOf({1, 1, {3}}, 2).empty());
}

TEST(Isolines, AreOfRoundLevels) {
    EXPECT_EQ(roundLevels(120, 560, 9), (std::vector<double>{150, 200, 250, 300, 350, 400, 450, 500, 550}));
    EXPECT_TRUE(roundLevels(5, 5, 9).empty());
    EXPECT_TRUE(roundLevels(0, std::numeric_limits<double>::infinity(), 9).empty());
}

}  // namespace
}  // namespace penumbra::studio
