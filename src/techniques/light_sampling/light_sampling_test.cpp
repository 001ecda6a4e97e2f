// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/light_sampling/light_sampling_test.h"

#include <filesystem>
#include <optional>

#include "src/device/device_internals.h"
#include "studio/scene/open_scene.h"

namespace penumbra::studio {
namespace {

/// Looking straight down on the half-plane scene, where V = clamp(1/2 + x): C1 of the closed forms.
double rampRmse(const LightResult& result, PictureSize size) {
    double squares = 0;
    int samples = 0;
    for (int y = 0; y < size.height_px; ++y) {
        for (int x = 0; x < size.width_px; ++x) {
            const double truth =
                0.5 + ((x + 0.5) / size.width_px - 0.5) * 3.0 * size.width_px / size.height_px;
            if (truth <= 0.01 || truth >= 0.99) continue;
            squares += std::pow(result.visibility.at(x, y) - truth, 2);
            ++samples;
        }
    }
    return std::sqrt(squares / samples);
}

Scene halfPlaneFromAbove() {
    return withMoment(makeBuiltin("half-plane"),
                      [](SceneMoment& moment) { moment.cameras.erase(moment.cameras.begin()); });
}

TEST_F(LightSamplingTest, MoreSamplesAreNearerToTheClosedForm) {
    // n columns of cells quantise the ramp in steps of 1/n: an error of 1 / (n sqrt(12)) rms, 0.072 and
    // 0.024.
    const Scene scene = halfPlaneFromAbove();
    const double coarse = rampRmse(render("uniform", scene, size, with({{"samples", "4"}})), size);
    const double fine = rampRmse(render("uniform", scene, size, with({{"samples", "12"}})), size);
    EXPECT_NEAR(coarse, 0.072, 0.01);
    EXPECT_NEAR(fine, 0.024, 0.01);
}

TEST_F(LightSamplingTest, EverySampleOfAPatternCounts) {
    // Over the half-plane each pattern estimates the same ramp; the bound is twice that of 8 columns of
    // cells.
    const Scene scene = halfPlaneFromAbove();
    for (const char* pattern : {"cells", "corners", "sequence"}) {
        const LightResult result =
            render("uniform", scene, size, with({{"samples", "8"}, {"pattern", pattern}}));
        EXPECT_LE(rampRmse(result, size), 2 * 0.036) << pattern;
    }
}

TEST_F(LightSamplingTest, EveryShapeOfLightIsNearTheTruth) {
    for (const LightShape shape :
         {LightShape::rect, LightShape::disk, LightShape::sphere, LightShape::distant}) {
        const Scene scene = withLight(makeBuiltin("two-boxes"), [&](Light& light) {
            light.shape.shape = shape;
            light.shape.radius_m = 0.4f;
            light.shape.angle_rad = 0.2f;
        });
        const LightResult exact = truth(scene, size);
        for (const char* name : {"uniform", "adaptive"}) {
            // The paper's test is content with few samples where a penumbra spans few pixels; the truth is
            // not.
            Settings settings = {{"map_size", "512"}};
            const bool isUniform = name == std::string_view("uniform");
            settings.emplace_back(isUniform ? "samples" : "max_error", isUniform ? "8" : "0.02");
            // Steps of an eighth would be 0.036 rms; as much again for maps of 512 texels along edges.
            EXPECT_LE(judge(exact, render(name, scene, size, settings)).penumbra_rmse, 0.08)
                << name << " " << int(shape);
        }
    }
}

TEST_F(LightSamplingTest, BatchesAndPathsOfEvaluationAgree) {
    // The sums are the same addends in the same order, whether they stay in registers or go through a
    // texture. Maps of 2048 texels come in batches of 20.
    const Scene scene = makeBuiltin("two-boxes");
    const Settings few = {{"map_size", "2048"}, {"samples", "5"}};
    Settings byPass = few;
    byPass.push_back({"evaluation", "accumulation"});
    const LightResult array = render("uniform", scene, size, few);
    EXPECT_EQ(count(array, "batches"), 2);
    EXPECT_LE(largestDifference(array, render("uniform", scene, size, byPass)), 1e-6);

    // Nothing of three levels is left out, as it is of the deepest.
    const Settings bare = with({{"max_depth", "3"}, {"smooth", "false"}});
    const LightResult adaptive = render("adaptive", scene, size, bare);
    Settings bareByPass = bare;
    bareByPass.push_back({"evaluation", "accumulation"});
    EXPECT_LE(largestDifference(adaptive, render("adaptive", scene, size, bareByPass)), 1e-6);
}

TEST_F(LightSamplingTest, ManySamplesShareTheRoomThatIsLeft) {
    // Of 289 maps of 512 texels 120 fit: those that are compared stay, the others come and go.
    struct Layers : InspectionVisitor {
        int count = 0;
        void texture(const InspectedTexture& texture) override {
            if (texture.name == std::string_view("depth maps")) count = texture.layers;
        }
    } layers;
    const Scene scene = halfPlaneFromAbove();
    const LightResult uniform = render("uniform", scene, size, {});
    for (const Settings& settings : {Settings{{"min_depth", "4"}}, Settings{{"max_error", "1e-6"}}}) {
        const std::unique_ptr<Technique> technique = workbench().makeTechnique("adaptive");
        setParameter(*technique, "smooth", "false");
        setParameter(*technique, settings.front().first, settings.front().second);
        const LightResult first = render(*technique, scene, size);
        EXPECT_EQ(count(first, "samples"), 289);
        EXPECT_LE(rmsDifference(first, uniform), 1.0 / 289) << settings.front().first;
        technique->inspect(layers);
        EXPECT_EQ(layers.count, 120);
        EXPECT_EQ(first.visibility.values, render(*technique, scene, size).visibility.values);
    }
    // The filter between samples asks compared ones alone.
    const double smooth = rampRmse(render("adaptive", scene, size, {{"min_depth", "3"}}), size);
    EXPECT_LT(smooth, 0.7 * rampRmse(render("adaptive", scene, size, {{"smooth", "false"}}), size));
}

TEST_F(LightSamplingTest, LayersChosenByTheVertexShaderOrOneByOneAreTheSame) {
    const Scene scene = makeBuiltin("two-boxes");
    bool& layerFromVertexShader = internalsOf(workbench().device()).layerFromVertexShader;
    const bool before = layerFromVertexShader;
    const auto renderAll = [&] {
        return std::pair(render("uniform", scene, size, with({{"samples", "3"}})),
                         render("adaptive", scene, size, with({{"max_depth", "2"}})));
    };
    const auto whole = renderAll();
    layerFromVertexShader = false;
    const auto byLayer = renderAll();
    layerFromVertexShader = before;
    EXPECT_EQ(whole.first.visibility.values, byLayer.first.visibility.values);
    EXPECT_EQ(whole.second.visibility.values, byLayer.second.visibility.values);
}

TEST_F(LightSamplingTest, ToleranceAndCoarseComparisonNeedFewerSamples) {
    const Scene scene = makeBuiltin("torus");
    constexpr PictureSize larger{400, 225};  // the wider a penumbra in pixels, the more samples it takes
    const double all = count(render("adaptive", scene, larger, small()), "samples");
    EXPECT_LT(count(render("adaptive", scene, larger, with({{"tolerated", "50"}})), "samples"), all);
    EXPECT_LT(count(render("adaptive", scene, larger, with({{"comparison_scale", "0.25"}})), "samples"), all);
    EXPECT_EQ(count(render("adaptive", scene, size, with({{"tolerated", "1000000"}})), "samples"), 9);
}

TEST_F(LightSamplingTest, ASurfaceEdgeOnToTheLightIsNotShadowedByWhatLiesBehindIt) {
    // A side of the upper box sees a corner of the light over its horizon, edge-on: it is a tenth of a texel
    // wide there, and its plane, continued to the middle of the texel, lies behind the box below. 0.5 % of
    // all lit pixels are on that side.
    const Scene scene = makeBuiltin("two-boxes");
    constexpr PictureSize larger{320, 180};
    const LightResult exact = truth(scene, larger, 64);
    const LightResult result = render("uniform", scene, larger, {{"map_size", "512"}, {"samples", "8"}});
    EXPECT_LE(judge(exact, result).false_shadow, 0.0005);
    EXPECT_LE(judge(exact, result).leak, 0.0005);
}

TEST_F(LightSamplingTest, SmoothedBandsAreNearerToTheClosedForm) {
    // 9 columns of cells make steps of 1/9, an error of 0.032 rms; four points a cell make them four times
    // finer, 0.008. As much again for edges in maps of 256 texels.
    const Scene scene = halfPlaneFromAbove();
    const Settings coarse = {{"map_size", "256"}, {"max_depth", "4"}, {"max_samples", "81"}};
    Settings bare = coarse;
    bare.push_back({"smooth", "false"});
    EXPECT_GE(rampRmse(render("adaptive", scene, size, bare), size), 0.025);
    EXPECT_LE(rampRmse(render("adaptive", scene, size, coarse), size), 0.016);
}

TEST_F(LightSamplingTest, BoundOfTheErrorIsKeptAndHolds) {
    // Over the half-plane, where the truth is known and maps of 512 texels are finer than a pixel. Without
    // the filter no 17 columns can be as near as 0.01; the bound says so.
    const Scene scene = halfPlaneFromAbove();
    const LightResult result = render("adaptive", scene, size, {{"max_error", "0.01"}});
    EXPECT_GT(count(result, "bound of the error"), 0);
    EXPECT_LE(count(result, "bound of the error"), 0.01);
    EXPECT_LE(rampRmse(result, size), count(result, "bound of the error"));
    const LightResult bare = render("adaptive", scene, size, {{"max_error", "0.01"}, {"smooth", "false"}});
    EXPECT_EQ(count(bare, "samples"), 289);
    EXPECT_GT(count(bare, "bound of the error"), rampRmse(bare, size));
}

TEST_F(LightSamplingTest, ANarrowSunNeitherLeaksNorLeavesTheFeet) {
    // Posts under a low sun, where 14 % leaked of one map for all of the ground.
    const std::optional<std::filesystem::path> field = fieldScenes();
    if (!field) GTEST_SKIP() << "no scenes of the field here";
    for (const char* name : {"lowsun-e5", "lowsun-e1"}) {
        const Scene scene = openScene((*field / name).string() + ".glb");
        const VisibilityMetrics metrics =
            judge(truth(scene, {160, 90}), render("adaptive", scene, {160, 90}));
        EXPECT_LE(metrics.leak, 0.005) << name;
        EXPECT_LE(metrics.false_shadow, 0.005) << name;
        EXPECT_LE(metrics.penumbra_rmse, 0.15) << name;
    }
}

TEST_F(LightSamplingTest, RoomsAroundTheLightHaveNoSteps) {
    // Their maps are a cube's, between which nothing filters: nine samples made an error of 0.13.
    const std::optional<std::filesystem::path> field = fieldScenes();
    if (!field) GTEST_SKIP() << "no scenes of the field here";
    for (const char* name : {"room-0", "pcss-wall-2.5", "ceiling-h27"}) {
        const Scene scene = openScene((*field / name).string() + ".glb");
        const VisibilityMetrics metrics =
            judge(truth(scene, {160, 90}), render("adaptive", scene, {160, 90}));
        EXPECT_LE(metrics.penumbra_rmse, 0.05) << name;
        EXPECT_LE(metrics.false_shadow, 0.001) << name;
    }
}

}  // namespace
}  // namespace penumbra::studio
