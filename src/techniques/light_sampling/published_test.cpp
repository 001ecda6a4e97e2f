// SPDX-License-Identifier: Apache-2.0
// The paper's algorithm alone, and what of its future work can be selected.
#include "src/techniques/light_sampling/light_sampling_test.h"

namespace penumbra::studio {
namespace {

constexpr PictureSize larger{240, 136};  // the test sees penumbrae that are some pixels wide

/// Looking straight down on the half-plane scene, whose edge lies over x = 0, half way up to the light.
Scene halfPlaneFromAbove() {
    return withMoment(makeBuiltin("half-plane"),
                      [](SceneMoment& moment) { moment.cameras.erase(moment.cameras.begin()); });
}

/// Of the picture above from the truth at the ground's x in metres.
template <typename Truth>
double rmseAcross(const LightResult& result, PictureSize size, Truth truthAt) {
    double squares = 0;
    int samples = 0;
    for (int y = 0; y < size.height_px; ++y) {
        for (int x = 0; x < size.width_px; ++x) {
            const double truth =
                truthAt(((x + 0.5) / size.width_px - 0.5) * 3.0 * size.width_px / size.height_px);
            if (truth <= 0.01 || truth >= 0.99) continue;
            squares += std::pow(result.visibility.at(x, y) - truth, 2);
            ++samples;
        }
    }
    return std::sqrt(squares / samples);
}

double ramp(double x) {
    return 0.5 + x;
}

TEST_F(LightSamplingTest, AllPublishedSamplesAreFixedSampling) {
    // Where every quad is split: the same lattice, the same weights, the same maps.
    const Settings fixed = with({{"pattern", "corners"}, {"weights", "equal"}});
    for (const char* path : {"array", "accumulation"}) {
        const LightResult published = render("adaptive", halfPlaneFromAbove(), larger,
                                             with({{"published", "true"}, {"evaluation", path}}));
        ASSERT_EQ(count(published, "samples"), 289);
        EXPECT_LE(largestDifference(published, render("uniform", halfPlaneFromAbove(), larger, fixed)), 1e-5)
            << path;
    }
    const Scene window = makeBuiltin("textured-window");
    const LightResult textured = render(
        "adaptive", window, size,
        with({{"counting", "queries"}, {"lattice", "corners"}, {"weights", "paper"}, {"min_depth", "4"}}));
    ASSERT_EQ(count(textured, "samples"), 289);
    EXPECT_LE(rmsDifference(textured, render("uniform", window, size, fixed)), 0.01);
}

TEST_F(LightSamplingTest, QueriesAndCountersGrowTheSameTree) {
    const Settings counters = with({{"lattice", "corners"},
                                    {"weights", "paper"},
                                    {"min_depth", "0"},
                                    {"smooth", "false"},
                                    {"reuse", "false"}});
    for (const char* name : {"torus", "disk-and-sphere", "primitives"}) {
        const Scene scene = makeBuiltin(name);
        const LightResult queried = render("adaptive", scene, larger, with({{"published", "true"}}));
        const LightResult counted = render("adaptive", scene, larger, counters);
        EXPECT_EQ(count(queried, "samples"), count(counted, "samples")) << name;
        // Of the deepest samples those are not asked that lie between corners which agree.
        EXPECT_LE(rmsDifference(queried, counted), 0.003) << name;
    }
}

TEST_F(LightSamplingTest, PublishedOptionsNeedFewerSamples) {
    const Scene scene = makeBuiltin("primitives");
    const Settings published = with({{"published", "true"}});
    const auto samplesWith = [&](const char* key, const char* value) {
        Settings settings = published;
        settings.emplace_back(key, value);
        return count(render("adaptive", scene, larger, settings), "samples");
    };
    const double all = samplesWith("tolerated", "0");
    EXPECT_GT(all, 9);
    EXPECT_LT(samplesWith("tolerated", "50"), all);
    EXPECT_LT(samplesWith("comparison_scale", "0.25"), all);
    EXPECT_EQ(samplesWith("max_depth", "0"), 4);
    EXPECT_LE(samplesWith("max_samples", "10"), 10);
}

TEST_F(LightSamplingTest, AFilterSmoothsPublishedBands) {
    // 5 columns of samples: steps of a fifth, which kernels of 2 and 3 texels round off more and more.
    Settings settings = with({{"published", "true"}, {"max_depth", "2"}});
    settings.emplace_back("filter", "1");
    double before = 1;
    for (const char* filter : {"1", "2", "3"}) {
        settings.back().second = filter;
        const double rmse =
            rmseAcross(render("adaptive", halfPlaneFromAbove(), larger, settings), larger, ramp);
        EXPECT_LT(rmse, before) << filter;
        before = rmse;
    }
}

TEST_F(LightSamplingTest, JitteredColumnsMakeNoSteps) {
    // All 17 columns of cells make steps of 1/17, an error of 0.017 rms on an edge along them; 289 places at
    // random within their cells, 17 in each column, are about sqrt(17) times nearer.
    const Settings all = {{"map_size", "512"}, {"min_depth", "4"}, {"smooth", "false"}};
    Settings jittered = all;
    jittered.emplace_back("jitter", "1");
    const double steps = rmseAcross(render("adaptive", halfPlaneFromAbove(), size, all), size, ramp);
    const double without = rmseAcross(render("adaptive", halfPlaneFromAbove(), size, jittered), size, ramp);
    EXPECT_GE(steps, 0.012);
    EXPECT_LE(without, 0.6 * steps);
}

TEST_F(LightSamplingTest, ABallThatShinesFromItsInsideShowsItsVolume) {
    // The plane through the receiver and the edge cuts off a cap, at t radii from the centre: of its volume
    // (2 + 3 t - t^3) / 4 are left. (Nearer parts shine more by 1 / d^2, alike on both sides.)
    constexpr double radius_m = 0.5;
    const Scene scene = withLight(halfPlaneFromAbove(), [&](Light& light) {
        light.shape.shape = LightShape::sphere;
        light.shape.radius_m = float(radius_m);
    });
    const auto volume = [](double x) {
        const double t = std::clamp(2 * x / std::sqrt(x * x + 4) / radius_m, -1.0, 1.0);
        return (2 + 3 * t - t * t * t) / 4;
    };
    const LightResult inside = render("adaptive", scene, size,
                                      {{"map_size", "256"}, {"emission", "volume"}, {"counting", "queries"}});
    EXPECT_GE(count(inside, "samples"), 27);
    // Of 5 to 9 layers of samples: steps of a tenth are 0.029 rms.
    EXPECT_LE(rmseAcross(inside, size, volume), 0.03);
    const LightResult surface = render("adaptive", scene, size, {{"map_size", "256"}});
    EXPECT_GT(rmseAcross(surface, size, volume), rmseAcross(inside, size, volume)) << "another light";
}

}  // namespace
}  // namespace penumbra::studio
