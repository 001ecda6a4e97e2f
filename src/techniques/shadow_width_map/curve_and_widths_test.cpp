// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "penumbra/device.h"
#include "src/techniques/shadow_width_map/attenuation.h"
#include "src/techniques/shadow_width_map/widths_cpu.h"

namespace penumbra::shadow_width_map {
namespace {

// -- The curve
// -------------------------------------------------------------------------------------------------------

std::string complaintAbout(const AttenuationFunction& attenuation) {
    try {
        tabulateAttenuation(attenuation);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(Attenuation, PublishedCurvesHaveTheFiveProperties) {
    EXPECT_EQ(complaintAbout(linearAttenuation), "");
    EXPECT_EQ(complaintAbout(smoothAttenuation), "");
    const std::vector<float> table = tabulateAttenuation(linearAttenuation);
    EXPECT_EQ(table.front(), 1);
    EXPECT_EQ(table.back(), 0);
    EXPECT_EQ(table[table.size() / 8], 1 - attenuationTableEnd / 8);
    EXPECT_EQ(umbraBegins(table), 1);
}

TEST(Attenuation, ViolatedPropertyIsNamed) {
    const auto f = [](float sd, float sw) { return linearAttenuation(sd, sw); };
    EXPECT_NE(complaintAbout([&](float sd, float sw) { return 0.9f * f(sd, sw); }).find("property 1"),
              std::string::npos);
    EXPECT_NE(complaintAbout([&](float sd, float sw) {
                  return sd == 0 ? 1 : std::max(0.0f, 1 - sw);
              }).find("property 2"),
              std::string::npos);
    EXPECT_NE(complaintAbout([&](float sd, float sw) {
                  return sd == 0 || sw < sd ? 1.0f : 0.0f;
              }).find("property 3"),
              std::string::npos)
        << "level before its step: not strictly falling";
    EXPECT_NE(complaintAbout([&](float sd, float sw) {
                  return f(sd, sw) * (sd == 0 || sw < 0.4f * sd ? 1.0f : 0.3f);
              }).find("property 4"),
              std::string::npos);
    EXPECT_NE(complaintAbout([](float, float) {
                  return std::numeric_limits<float>::quiet_NaN();
              }).find("property 0"),
              std::string::npos);
}

// -- Widths
// ----------------------------------------------------------------------------------------------------------

/// A map as drawn: '#' blocks.
struct Drawing {
    explicit Drawing(const std::vector<std::string>& rows)
        : size(int(rows.size())), blocked(new bool[rows.size() * rows.size()]) {
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x)
                blocked[std::size_t(y) * rows.size() + std::size_t(x)] =
                    rows[std::size_t(y)][std::size_t(x)] == '#';
        }
    }
    std::span<const bool> span() const { return {blocked.get(), std::size_t(size * size)}; }
    int size;
    std::unique_ptr<bool[]> blocked;
};

TEST(Widths, SweepsCountStepsToTheNearestLitTexel) {
    const Drawing drawing({"######", "######", "##.###", "######", "######", "######"});
    const std::vector<float> widths = sweepShadowWidths(drawing.span(), drawing.size, 0.125f);
    for (int y = 0; y < 6; ++y) {
        for (int x = 0; x < 6; ++x) {
            EXPECT_EQ(widths[std::size_t(6 * y + x)], 0.125f * float(std::abs(x - 2) + std::abs(y - 2)));
        }
    }
}

TEST(Widths, SweepsStopAtOneWhereNothingIsLit) {
    const Drawing drawing({"###", "###", "###"});
    for (const float width : sweepShadowWidths(drawing.span(), 3, 0.25f)) EXPECT_EQ(width, 1);
}

/// Texels are drawn or not by their middles, which tells a silhouette's place to half a texel; packing may
/// add 0.05 (edge_cells.glsl), and a straight piece of 1.5 cells what it leaves the disk by.
TEST(Widths, ExactWidthsAreTheDistancesToADrawnDisk) {
    constexpr std::size_t size = 128;
    constexpr double radius_px = 40;
    const auto fromBorder = [](std::size_t x, std::size_t y, int cell_px) {
        return std::hypot((double(x) + 0.5) * cell_px - 61.3, (double(y) + 0.5) * cell_px - 66.8) - radius_px;
    };
    const auto blocked = std::make_unique<bool[]>(size * size);
    for (std::size_t y = 0; y < size; ++y) {
        for (std::size_t x = 0; x < size; ++x) blocked[y * size + x] = fromBorder(x, y, 1) < 0;
    }
    for (const int cell_px : {1, 2, 4, 8}) {
        const std::vector<float> widths = exactShadowWidths({blocked.get(), size * size}, size, cell_px);
        const std::size_t cells = size / std::size_t(cell_px);
        double worst = 0;
        for (std::size_t y = 0; y < cells; ++y) {
            for (std::size_t x = 0; x < cells; ++x) {
                const double truth = std::abs(fromBorder(x, y, cell_px));
                worst = std::max(worst, std::abs(double(widths[y * cells + x]) - truth));
            }
        }
        EXPECT_LE(worst, 0.55 + std::pow(0.75 * cell_px, 2) / (2 * radius_px)) << cell_px;
    }
}

TEST(Widths, WithoutABlockerNothingIsNear) {
    const Drawing drawing({"...", "...", "..."});
    for (const float width : exactShadowWidths(drawing.span(), 3, 1)) EXPECT_TRUE(std::isinf(width));
}

}  // namespace
}  // namespace penumbra::shadow_width_map
