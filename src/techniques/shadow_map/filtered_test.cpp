// SPDX-License-Identifier: Apache-2.0
// pcf and pcss: closed forms, their kernels' known answers, cube faces, and the reference.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>

#include "studio/scene/builtin/builtin.h"
#include "studio/scene/open_scene.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

using PcfTest = TechniqueTest;
using PcssTest = TechniqueTest;

constexpr PictureSize plan{160, 90};  // 5.33 m x 3 m, see scenes_closed_form.cpp

/// The scene seen straight down, with its light changed.
Scene fromAbove(
    std::string_view name, const std::function<void(AreaLight&)>& change = [](AreaLight&) {}) {
    return withMoment(makeBuiltin(name), [change](SceneMoment& moment) {
        moment.cameras.erase(moment.cameras.begin());
        change(moment.lights.front().shape);
    });
}

/// Metres from the picture's middle.
glm::dvec2 placeOf(int x, int y) {
    return 3.0 / plan.height_px * glm::dvec2(x + 0.5 - 0.5 * plan.width_px, y + 0.5 - 0.5 * plan.height_px);
}

/// The largest difference from `expected(place)` over the picture's middle row and column.
double largestError(const LightResult& result, const std::function<double(glm::dvec2)>& expected) {
    double largest = 0;
    const auto look = [&](int x, int y) {
        largest = std::max(largest, std::abs(result.visibility.at(x, y) - expected(placeOf(x, y))));
    };
    for (int x = 0; x < plan.width_px; ++x) look(x, plan.height_px / 2);
    for (int y = 0; y < plan.height_px; ++y) look(plan.width_px / 2, y);
    return largest;
}

/// Share of a disk that a half-plane leaves free, its edge at the signed distance d (in radii) from the
/// centre.
double freeOfDisk(double d) {
    d = std::clamp(d, -1.0, 1.0);
    return (std::acos(d) - d * std::sqrt(1 - d * d)) / std::numbers::pi;
}

/// Area common to two disks whose centres are c apart.
double lensArea(double R, double r, double c) {
    if (c >= R + r) return 0;
    if (c <= std::abs(R - r)) return std::numbers::pi * std::min(R, r) * std::min(R, r);
    return r * r * std::acos((c * c + r * r - R * R) / (2 * c * r)) +
           R * R * std::acos((c * c + R * R - r * r) / (2 * c * R)) -
           0.5 * std::sqrt((-c + r + R) * (c + r - R) * (c - r + R) * (c + r + R));
}

std::size_t partlyLit(const LightResult& result) {
    return std::size_t(
        std::ranges::count_if(result.visibility.values, [](float v) { return v > 1e-5f && v < 1 - 1e-5f; }));
}

// 64 points cut the light into 64 strips, of which an edge is wrong by one at most; a texel of the map moves
// the edge by another 0.005.
constexpr double rectTolerance = 1.0 / 64 + 0.01;
// The spiral's points are less even along one axis: an edge is wrong by two or three of them.
constexpr double diskTolerance = 3.0 / 64 + 0.01;

TEST_F(PcssTest, HalfPlaneUnderRectIsTheClosedForm) {
    for (const double width_m : {1.0, 0.3, 2.0}) {
        const Scene scene =
            fromAbove("half-plane", [=](AreaLight& light) { light.width_m = float(width_m); });
        const LightResult result = render("pcss", scene, plan);
        // Nothing but the light's width, across the edge, may matter. Its height stays 1 m.
        EXPECT_LE(
            largestError(result, [=](glm::dvec2 p) { return std::clamp(0.5 + p.x / width_m, 0.0, 1.0); }),
            rectTolerance)
            << width_m;
    }
}

TEST_F(PcssTest, HalfPlaneUnderDiskIsTheClosedForm) {
    const Scene scene = fromAbove("half-plane", [](AreaLight& light) {
        light.shape = LightShape::disk;
        light.radius_m = 0.5f;
    });
    EXPECT_LE(largestError(render("pcss", scene, plan), [](glm::dvec2 p) { return freeOfDisk(-p.x / 0.5); }),
              diskTolerance);
}

TEST_F(PcssTest, StripIsTheClosedForm) {
    // C3: the strip |x| < 0.2 m hides, from x, what lies between -x - 0.4 and -x + 0.4 of the light's -0.5 to
    // 0.5.
    const auto expected = [](glm::dvec2 p) {
        return 1 - std::max(0.0, std::min(0.5, 0.4 - p.x) - std::max(-0.5, -0.4 - p.x));
    };
    // Two edges may each be wrong by a sample.
    EXPECT_LE(largestError(render("pcss", fromAbove("strip"), plan), expected), 2 * rectTolerance);
}

TEST_F(PcssTest, DiskUnderDiskIsTheClosedForm) {
    const auto expected = [](glm::dvec2 p) {
        return 1 - lensArea(0.5, 0.8, glm::length(p)) / (std::numbers::pi * 0.25);
    };
    EXPECT_LE(largestError(render("pcss", fromAbove("disk-over-ground"), plan), expected), diskTolerance);
}

TEST_F(PcssTest, MoreSamplesAreNearerToTheClosedForm) {
    const auto error = [](const char* samples) {
        return largestError(render("pcss", fromAbove("half-plane"), plan, {{"filter_samples", samples}}),
                            [](glm::dvec2 p) { return std::clamp(0.5 + p.x, 0.0, 1.0); });
    };
    // From a sample of 8 to the map's own texels.
    EXPECT_LT(error("256"), 0.4 * error("8"));
}

TEST_F(PcssTest, LightWithoutSizeIsHard) {
    for (const char* name : {"primitives", "columns"}) {
        const Scene scene = withLight(makeBuiltin(name), shrinkToPoint);
        // The same maps and places; the comparison is another at the horizon of a texel alone.
        EXPECT_LE(shareOfDifferentPixels(render("hard", scene), render("pcss", scene), 0.01f), 0.002) << name;
    }
}

TEST_F(PcssTest, EveryShapeIsNearTheReference) {
    struct Case {
        LightShape shape;
        double penumbraRmse;
    };
    // What a single map from the centre leaves: measured 0.02 to 0.04 with one box over another.
    for (const auto& [shape, penumbraRmse] :
         {Case{LightShape::rect, 0.06}, Case{LightShape::disk, 0.06}, Case{LightShape::sphere, 0.06},
          Case{LightShape::distant, 0.08}}) {
        const Scene scene = withLight(makeBuiltin("two-boxes"), [shape = shape](Light& light) {
            light.shape.shape = shape;
            light.shape.radius_m = 0.3f;
            light.shape.angle_rad = 0.15f;
        });
        const VisibilityMetrics metrics = judge(truth(scene), render("pcss", scene));
        EXPECT_LE(metrics.penumbra_rmse, penumbraRmse) << int(shape);
        EXPECT_GT(metrics.penumbraSamples, 100u) << int(shape);
        EXPECT_LE(metrics.false_shadow, 0.002) << int(shape);
    }
}

TEST_F(PcssTest, CubeOfMapsIsNearTheReference) {
    // Filters cross from face to face; what is not looked up in the right one shows as false light or shadow.
    // In the corner beyond a column the other wall is seen within the filter: it stops short of the corner's
    // shadow.
    for (const auto& [scene, penumbraRmse] :
         {std::pair(onReceivingGround(makeBuiltin("columns")), 0.06), {makeBuiltin("columns"), 0.09}}) {
        const LightResult result = render("pcss", scene);
        EXPECT_GT(result.statistics.counts.front().value, 1) << "maps";
        const VisibilityMetrics metrics = judge(truth(scene), result);
        EXPECT_LE(metrics.penumbra_rmse, penumbraRmse);
        EXPECT_LE(metrics.false_shadow, 0.001);
    }
}

TEST_F(PcssTest, RotatedPatternsAgreeOnAverage) {
    const LightResult rotated = render("pcss", fromAbove("half-plane"), plan, {{"pattern", "rotated"}});
    // Columns of 90 pixels, each with 64 samples of its own place: their mean is that much nearer.
    for (int x = 0; x < plan.width_px; ++x) {
        double mean = 0;
        for (int y = 0; y < plan.height_px; ++y) mean += rotated.visibility.at(x, y) / double(plan.height_px);
        EXPECT_NEAR(mean, std::clamp(0.5 + placeOf(x, 0).x, 0.0, 1.0), 0.015) << x;
    }
}

TEST_F(PcssTest, TexturedLightIsNearTheReference) {
    // The same half-plane under a light that is red on one side and green on the other.
    Scene scene = makeBuiltin("half-plane");
    scene.pictures.push_back(
        {.name = "halves", .width_px = 2, .height_px = 1, .rgba = {255, 0, 64, 255, 0, 255, 64, 255}});
    scene.textures.push_back(
        {.picture = int(scene.pictures.size()) - 1, .minFilter = 0x2600, .magFilter = 0x2600});  // GL_NEAREST
    const int texture = int(scene.textures.size()) - 1;
    scene = withLight(std::move(scene), [=](Light& light) { light.texture = texture; });
    const LightResult result = render("pcss", scene);
    ASSERT_EQ(result.visibility.channels, 3);
    const VisibilityMetrics metrics = judge(truth(scene), result);
    EXPECT_GT(metrics.penumbraSamples, 1000u);
    EXPECT_LE(metrics.penumbra_rmse, 0.03);  // a sample of 32, and the reference's own noise
}

TEST_F(PcssTest, HarmonicMeanLeaksLess) {
    // A ball and a rod high above two bars: behind the bars all is dark.
    const Scene scene = makeBuiltin("overlapping-blockers");
    const LightResult exact = truth(scene);
    const double harmonic = judge(exact, render("pcss", scene)).leak;
    const double arithmetic =
        judge(exact, render("pcss", scene, defaultSize, {{"blocker_mean", "arithmetic"}})).leak;
    EXPECT_LT(harmonic, 0.5 * arithmetic);
}

TEST_F(PcfTest, PoissonDiskOfRadiusZeroIsBilinear) {
    const Scene scene = makeBuiltin("two-boxes");
    const LightResult bilinear = render("pcf", scene, defaultSize, {{"kernel", "2x2"}, {"map_size", "256"}});
    const LightResult disk =
        render("pcf", scene, defaultSize, {{"kernel", "poisson"}, {"radius", "0"}, {"map_size", "256"}});
    EXPECT_LE(shareOfDifferentPixels(bilinear, disk, 1e-5f), 0);
}

TEST_F(PcfTest, KernelsAreAsWideAsTheySay) {
    // A map of so few texels that the picture resolves them. The edge lies between two texels, so that a
    // kernel over 2, 4 or 6 of them takes 1, 3 or 5 to cross it.
    const Scene scene = fromAbove("half-plane");
    const auto width_px = [&](const char* kernel, int reach_texels) {
        const LightResult result = render("pcf", scene, plan, {{"kernel", kernel}, {"map_size", "24"}});
        // Windows grow by what the kernel reaches beyond them, and with them the texels.
        return double(partlyLit(result)) / plan.height_px * (24 - 2 * reach_texels) / 24;
    };
    const double texel_px = width_px("2x2", 1);
    EXPECT_GT(texel_px, 5);
    // A column of pixels more or less at either end.
    EXPECT_NEAR(width_px("3x3", 2) / texel_px, 3, 0.4);
    EXPECT_NEAR(width_px("5x5", 3) / texel_px, 5, 0.4);
    EXPECT_NEAR(width_px("bicubic", 2) / texel_px, 3, 0.4);
}

TEST_F(PcfTest, VisibilityRisesSteadilyAcrossAnEdge) {
    const Scene scene = fromAbove("half-plane");
    for (const char* kernel : {"2x2", "3x3", "5x5", "bicubic"}) {
        const LightResult result = render("pcf", scene, plan, {{"kernel", kernel}, {"map_size", "24"}});
        float largestStep = 0;
        for (int x = 1; x < plan.width_px; ++x) {
            const float step = result.visibility.at(x, 45) - result.visibility.at(x - 1, 45);
            EXPECT_GE(step, -1e-5f) << kernel << " at column " << x;
            largestStep = std::max(largestStep, step);
        }
        // A texel is more than five pixels wide, and no kernel is steeper than the bilinear one.
        EXPECT_LE(largestStep, 0.2f) << kernel;
    }
}

TEST_F(PcfTest, KernelsKeepWhatIsWhollyLitOrDark) {
    const Scene scene = makeBuiltin("columns");
    const LightResult hard = render("hard", scene);
    for (const char* kernel : {"2x2", "3x3", "5x5", "bicubic", "poisson"}) {
        const LightResult result = render("pcf", scene, defaultSize, {{"kernel", kernel}});
        // A hard edge is some texels wide at most, a few percent of the picture's pixels.
        EXPECT_LE(shareOfDifferentPixels(hard, result, 0.001f), 0.08) << kernel;
        EXPECT_GT(shareOfDifferentPixels(hard, result, 0.001f), 0.0) << kernel;
    }
}

TEST_F(PcfTest, CubeOfMapsHasNoSeams) {
    // Nothing casts, so that any texel that a kernel misses beyond a face's edge shows.
    const Scene scene = withMoment(makeBuiltin("columns"), [](SceneMoment& moment) {
        for (Instance& instance : moment.instances) instance.casts = false;
    });
    const Scene edge = makeBuiltin("columns");
    for (const char* kernel : {"5x5", "poisson"}) {
        const LightResult result = render("pcf", scene, defaultSize, {{"kernel", kernel}, {"radius", "32"}});
        const LightResult hard = render("hard", scene);
        EXPECT_LE(shareOfDifferentPixels(hard, result, 1e-5f), 0) << kernel;
        // With casters: no false shadow along the faces' edges either.
        const VisibilityMetrics metrics =
            judge(truth(edge, defaultSize, 64),
                  render("pcf", edge, defaultSize, {{"kernel", kernel}, {"radius", "4"}}));
        EXPECT_LE(metrics.false_shadow, 0.01) << kernel;
    }
}

TEST_F(PcssTest, WhatStandsBesideTheLightHidesNothing) {
    // Rooms whose walls and ceilings reach the panel's height: 3 to 74 % were dark.
    const std::optional<std::filesystem::path> field = fieldScenes();
    if (!field) GTEST_SKIP() << "no scenes of the field here";
    for (const char* name :
         {"pcss-wall-2.5", "room-0", "room-1mm", "ceiling-h27", "ceiling-below_0.05", "ceiling-rot_tilt"}) {
        const Scene scene = openScene((*field / name).string() + ".glb");
        const VisibilityMetrics metrics = judge(truth(scene, plan), render("pcss", scene, plan));
        EXPECT_LE(metrics.false_shadow, 0.01) << name;
    }
}

}  // namespace
}  // namespace penumbra::studio
