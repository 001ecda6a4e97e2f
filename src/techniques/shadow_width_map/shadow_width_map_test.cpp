// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/shadow_width_map/shadow_width_map.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <memory>
#include <optional>

#include "src/gl/gl.h"
#include "src/techniques/shadow_width_map/map_cameras.h"
#include "src/techniques/shadow_width_map/widths_cpu.h"
#include "studio/scene/builtin/builtin.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

using shadow_width_map::exactShadowWidths;
using shadow_width_map::fitMapCameras;

class ShadowWidthTest : public TechniqueTest {
  protected:
    static constexpr PictureSize size{160, 120};
    static constexpr int rays = 64;  ///< noise of at most 0.06 a pixel: 0.004 more in an RMS of 0.08

    static double penumbraRmse(const LightResult& exact, const LightResult& result) {
        return judge(exact, result).penumbra_rmse;
    }

    /// The first layer of an inspected texture.
    static std::vector<float> texels(const Technique& technique, std::string_view name, GLenum format,
                                     int size_px) {
        class Finder final : public InspectionVisitor {
          public:
            explicit Finder(std::string_view name) : name_(name) {}
            void texture(const InspectedTexture& inspected) override {
                if (inspected.name == name_) found = inspected.texture;
            }
            GLuint found = 0;

          private:
            std::string_view name_;
        };
        Finder finder(name);
        technique.inspect(finder);
        std::vector<float> values(std::size_t(size_px) * std::size_t(size_px));
        glGetTextureSubImage(finder.found, 0, 0, 0, 0, size_px, size_px, 1, format, GL_FLOAT,
                             GLsizei(values.size() * sizeof(float)), values.data());
        return values;
    }

    static double timesMade(const LightResult& result) {
        return std::ranges::find(result.statistics.counts, "times the maps were made", &Statistic::name)
            ->value;
    }
};

/// The device packs places in sixteenths of a texel and directions in hundredths of a radian.
TEST_F(ShadowWidthTest, WidthsOfTheDeviceAndTheCpuAgreeToHalfATexel) {
    for (const char* scene : {"primitives", "torus"}) {
        for (const int map_px : {97, 200, 331, 600}) {
            const std::unique_ptr<Technique> technique = workbench().makeTechnique("shadow-width");
            setParameter(*technique, "map_size", std::to_string(map_px));
            render(*technique, makeBuiltin(scene), {32, 24});
            const std::vector<float> depths = texels(*technique, "depth map", GL_DEPTH_COMPONENT, map_px);
            const int cell_px = map_px > 256   ? 4
                                : map_px > 128 ? 2
                                               : 1,
                      cells = (map_px + cell_px - 1) / cell_px;
            const std::vector<float> widths =
                texels(*technique, "distance to the nearest edge", GL_RED, cells);
            const auto blocked = std::make_unique<bool[]>(depths.size());
            std::ranges::transform(depths, blocked.get(), [](float depth) { return depth > 0; });
            const std::vector<float> exact =
                exactShadowWidths({blocked.get(), depths.size()}, map_px, cell_px);
            ASSERT_TRUE(std::ranges::any_of(exact, [](float d) { return d > 5 && std::isfinite(d); }));
            for (std::size_t i = 0; i < widths.size(); ++i)
                ASSERT_NEAR(widths[i], exact[i], 0.5f) << scene << " " << map_px << " cell " << i;
        }
    }
}

// -- Against the reference
// -------------------------------------------------------------------------------------------

/// One blocker, and a light no wider than a tenth of its distance.
Scene singleBlocker(const char* name) {
    return withLight(makeBuiltin(name), [](Light& light) {
        light.shape.width_m = light.shape.height_m = 0.4f;
        light.shape.radius_m = 0.2f;
    });
}

TEST_F(ShadowWidthTest, SingleBlockersAreNearTheTruth) {
    for (const char* name : {"half-plane", "disk-over-ground", "sphere", "torus"}) {
        const Scene scene = singleBlocker(name);
        const LightResult exact = truth(scene, size, rays);
        const VisibilityMetrics ours = judge(exact, render("shadow-width", scene, size));
        EXPECT_LE(ours.penumbra_rmse, 0.08) << name << ": the figure that was asked for";
        EXPECT_LT(ours.penumbra_rmse, penumbraRmse(exact, render("hard", scene, size))) << name;
        for (const char* mode : {"compositing", "cpu-sweep"}) {
            // Smaller maps than by default, to save time; none of these penumbrae is wider than 64 of their
            // texels.
            const LightResult published =
                render("shadow-width", scene, size,
                       {{"mode", mode}, {"map_size", "512"}, {"start_difference", "1/64"}});
            EXPECT_LT(ours.penumbra_rmse, penumbraRmse(exact, published)) << name << " " << mode;
        }
    }
}

TEST_F(ShadowWidthTest, EveryShapeOfLightHasItsPenumbra) {
    for (const LightShape shape :
         {LightShape::rect, LightShape::disk, LightShape::sphere, LightShape::distant}) {
        for (const bool turned : {false, true}) {
            const Scene scene = withLight(makeBuiltin("torus"), [&](Light& light) {
                light.shape.shape = shape;
                light.shape.width_m = 1;
                light.shape.height_m = turned ? 1 : 0.2f;
                light.shape.radius_m = 0.3f;
                light.shape.angle_rad = 0.12f;
            });
            const LightResult exact = truth(scene, size, rays);
            EXPECT_LE(penumbraRmse(exact, render("shadow-width", scene, size)), 0.1) << int(shape);
            if (shape != LightShape::rect) break;
        }
    }
}

/// Figure 7: with widths filtered linearly, a shadow of 64 x 64 texels has an outer boundary that jumps.
TEST_F(ShadowWidthTest, SmallMapsStayNearTheTruth) {
    const Scene scene = makeBuiltin("disk-and-sphere");
    const LightResult exact = truth(scene, size, rays);
    const double ours = penumbraRmse(exact, render("shadow-width", scene, size, {{"map_size", "64"}}));
    EXPECT_LE(ours, 0.14);
    EXPECT_LT(ours, penumbraRmse(exact, render("hard", scene, size, {{"map_size", "64"}})));
    EXPECT_LT(ours, penumbraRmse(exact,
                                 render("shadow-width", scene, size,
                                        {{"map_size", "64"}, {"mode", "compositing"}, {"neighbours", "6"}})));
}

/// Figure 5, and shadows on what casts shadows itself.
TEST_F(ShadowWidthTest, InnerEdgesGiveShadowsOnCastersTheirPenumbra) {
    const Scene scene = makeBuiltin("overlapping-blockers");
    const LightResult exact = truth(scene, size, rays);
    const double with = penumbraRmse(exact, render("shadow-width", scene, size));
    EXPECT_LT(with,
              0.8 * penumbraRmse(exact, render("shadow-width", scene, size, {{"inner_edges", "false"}})));
    EXPECT_LT(with, 0.5 * penumbraRmse(exact, render("hard", scene, size)));
}

TEST_F(ShadowWidthTest, LightsAmongTheCastersHaveNoSeams) {
    const Scene scene =
        withMoment(makeBuiltin("columns"), [](SceneMoment& moment) { moment.lights.resize(1); });
    const LightResult exact = truth(scene, size, rays);
    const LightResult ours = render("shadow-width", scene, size);
    EXPECT_GT(ours.statistics.counts.front().value, 1) << "maps";
    EXPECT_LE(judge(exact, ours).rmse, 0.5 * judge(exact, render("hard", scene, size)).rmse);
}

/// A strip narrower than its penumbra, of which light is seen past both sides; and a lit gap between two.
TEST_F(ShadowWidthTest, LightIsSeenPastBothSidesOfANarrowBlocker) {
    const Scene scene = makeBuiltin("strip");
    const LightResult exact = truth(scene, size, rays);
    EXPECT_LE(penumbraRmse(exact, render("shadow-width", scene, size)), 0.015)
        << "noise of the reference is 0.006; the nearer side alone: 0.021";
}

TEST_F(ShadowWidthTest, WhatEndsBeneathAnotherCasterKeepsItsUmbra) {
    const Scene scene = makeBuiltin("overlapping-blockers");
    const LightResult exact = truth(scene, {320, 180}, rays);
    const VisibilityMetrics with = judge(exact, render("shadow-width", scene, {320, 180}));
    const VisibilityMetrics without =
        judge(exact, render("shadow-width", scene, {320, 180}, {{"hidden_edges", "false"}}));
    EXPECT_LT(with.leak, 0.6 * without.leak);
    EXPECT_LT(with.penumbra_rmse, without.penumbra_rmse);
}

// -- Bad and borderline input
// ----------------------------------------------------------------------------------------

TEST_F(ShadowWidthTest, BlockersThatFillTheMapLeaveNoLight) {
    const Scene scene = withMoment(makeBuiltin("half-plane"), [](SceneMoment& moment) {
        for (Instance& instance : moment.instances) {
            if (!isGround(instance)) instance.worldFromMesh[3].x = 0;
        }
    });
    for (const char* mode : {"exact", "compositing", "cpu-sweep"}) {
        const LightResult result =
            render("shadow-width", scene, {40, 30}, {{"mode", mode}, {"map_size", "100"}});
        EXPECT_TRUE(std::ranges::all_of(result.visibility.values, [](float v) { return v == 0; })) << mode;
    }
}

TEST_F(ShadowWidthTest, WithoutABlockerEverythingIsLit) {
    const Scene scene = withMoment(makeBuiltin("half-plane"), [](SceneMoment& moment) {
        for (Instance& instance : moment.instances) instance.casts = false;
    });
    for (const char* mode : {"exact", "compositing", "cpu-sweep"}) {
        const LightResult result =
            render("shadow-width", scene, {40, 30}, {{"mode", mode}, {"map_size", "100"}});
        EXPECT_TRUE(std::ranges::all_of(result.visibility.values, [](float v) { return v == 1; })) << mode;
    }
}

/// But for pixels whose texel the silhouette cuts: maps of the two differ in size and place.
TEST_F(ShadowWidthTest, ALightWithoutASizeCastsHardShadows) {
    const Scene scene = withLight(makeBuiltin("primitives"), shrinkToPoint);
    const LightResult hard = render("hard", scene, size);
    for (const char* mode : {"exact", "compositing", "cpu-sweep"}) {
        const LightResult ours = render("shadow-width", scene, size, {{"mode", mode}, {"map_size", "2048"}});
        EXPECT_LE(shareOfDifferentPixels(hard, ours, 0.01f), 0.01) << mode;
    }
}

TEST_F(ShadowWidthTest, EveryMapSizeWorksInEveryMode) {
    for (const char* mode : {"exact", "compositing", "cpu-sweep"}) {
        for (const char* map : {"16", "64", "97", "300"}) {
            const LightResult result =
                render("shadow-width", makeBuiltin("primitives"), {64, 48},
                       {{"mode", mode}, {"map_size", map}, {"start_difference", "1/16"}});
            EXPECT_TRUE(
                std::ranges::all_of(result.visibility.values, [](float v) { return v >= 0 && v <= 1; }));
        }
    }
}

TEST_F(ShadowWidthTest, ScaleOfZeroIsNoShadowAndNonsenseIsRefused) {
    const Scene scene = makeBuiltin("torus");
    const LightResult result = render("shadow-width", scene, {64, 48},
                                      {{"mode", "compositing"}, {"physical", "false"}, {"c_scale", "0"}});
    // What is turned away from the light stays dark.
    EXPECT_TRUE(std::ranges::all_of(result.visibility.values, [](float v) { return v == 0 || v == 1; }));
    EXPECT_GT(std::ranges::count(result.visibility.values, 1.0f), 60 * 48);
    const std::unique_ptr<Technique> technique = workbench().makeTechnique("shadow-width");
    for (const char* value : {"-1", "nan", "-inf", "x"}) {
        EXPECT_THROW(setParameter(*technique, "c_scale", value), Error) << value;
    }
    for (const char* value : {"0", "-64", "15", "4097"}) {
        EXPECT_THROW(setParameter(*technique, "map_size", value), Error) << value;
    }
}

TEST_F(ShadowWidthTest, MapsAreMadeAnewOnlyWhenSomethingInThemHasChanged) {
    const std::unique_ptr<Technique> technique = workbench().makeTechnique("shadow-width");
    const Scene scene = makeBuiltin("two-boxes");
    const SceneMoment moment = scene.at(0);
    workbench().open(scene);
    const auto run = [&](const SceneMoment& now) {
        return workbench().run("test", *technique, now, now.cameras.front(), {64, 48}).lights.at(0);
    };
    const LightResult first = run(moment);
    const LightResult again = run(moment);
    EXPECT_EQ(timesMade(again), timesMade(first));
    EXPECT_EQ(first.visibility.values, again.visibility.values);

    SceneMoment moved = scene.at(0);
    for (Instance& instance : moved.instances) {
        if (!isGround(instance)) instance.worldFromMesh[3].y += 0.1f;
    }
    const LightResult after = run(moved);
    EXPECT_EQ(timesMade(after), timesMade(first) + 1);
    EXPECT_EQ(after.visibility.values, render("shadow-width",
                                              withMoment(makeBuiltin("two-boxes"),
                                                         [](SceneMoment& m) {
                                                             for (Instance& instance : m.instances) {
                                                                 if (!isGround(instance))
                                                                     instance.worldFromMesh[3].y += 0.1f;
                                                             }
                                                         }),
                                              {64, 48})
                                           .visibility.values);

    setParameter(*technique, "reuse_maps", "false");
    workbench().open(scene);
    const double before = timesMade(run(moment));
    EXPECT_EQ(timesMade(run(moment)), before + 1);
}

/// As the paper has it: maps are reused when neither light nor blockers moved. They are what they would have
/// been without the views before.
TEST_F(ShadowWidthTest, SmallMovesOfTheCameraKeepTheMaps) {
    const std::unique_ptr<Technique> technique = workbench().makeTechnique("shadow-width");
    const Scene scene = makeBuiltin("overlapping-blockers");
    const SceneMoment moment = scene.at(0);
    workbench().open(scene);
    const auto viewAt = [&](int frame) {
        Camera camera = moment.cameras.front();
        camera.worldFromCamera = glm::rotate(glm::dmat4(1), 0.001 * frame, glm::dvec3(0, 1, 0)) *
                                 glm::dmat4(camera.worldFromCamera);
        return camera;
    };
    const auto run = [&](Technique& of, int frame) {
        return workbench().run("test", of, moment, viewAt(frame), {64, 48}).lights.at(0);
    };
    constexpr int frames = 40;
    LightResult last;
    for (int frame = 0; frame < frames; ++frame) last = run(*technique, frame);
    EXPECT_LE(timesMade(last), frames / 8) << "a turn of 2.3 degrees";
    const std::unique_ptr<Technique> fresh = workbench().makeTechnique("shadow-width");
    EXPECT_EQ(run(*fresh, frames - 1).visibility.values, last.visibility.values);
}

TEST(MapCameras, SteadyWindowsHoldAllThatIsWantedAndLittleMore) {
    const AreaLight light{.shape = LightShape::disk, .radius_m = 0};
    for (int i = 0; i < 200; ++i) {
        // A receiver in front of the light, a little larger and farther to the side each time.
        const double half = 0.3 + 0.001 * i, side = 0.0137 * (i % 40);
        LightSpaceScene scene;
        ReceiverRegion::Polygon polygon;
        for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
            polygon.push_back(glm::dvec3(side + half * x, half * y, -3));
        scene.receivers.polygons.push_back(polygon);
        const LightCameras wanted = fitLightCameras(light, scene, {.mapSize_px = 1024, .steadyAxis = true});
        const LightCameras steady = fitMapCameras(light, scene, 1024);
        ASSERT_EQ(steady.size(), 1u);
        const LightCamera &before = wanted[0], &after = steady[0];
        EXPECT_EQ(before.faceFromLight, after.faceFromLight);
        EXPECT_TRUE(glm::all(glm::lessThanEqual(after.windowMin, before.windowMin)));
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(after.windowMax, before.windowMax)));
        const glm::dvec2 extent = before.windowMax - before.windowMin;
        EXPECT_LE(after.windowMax.x - after.windowMin.x, 1.08 * std::max(extent.x, extent.y));
    }
}

/// Only a host can tell whether a mask's texels are the same as before.
TEST_F(ShadowWidthTest, MapsOfMaskedCastersAreKeptWhileTheMaskHasTheSameRevision) {
    const Scene scene =
        withAlphaMask(makeBuiltin("two-boxes"),
                      {.name = "solid", .width_px = 1, .height_px = 1, .rgba = {255, 255, 255, 255}});
    const SceneMoment moment = scene.at(0);
    workbench().open(scene);
    workbench().scene().update(moment);
    workbench().frame().draw(workbench().scene(), moment, moment.cameras.front(), 64, 48);
    ShadowInputs inputs = workbench().frame().shadowInputs(moment.lights.front());
    std::vector<Caster> casters(inputs.casters.begin(), inputs.casters.end());
    inputs.casters = casters;

    const std::unique_ptr<Technique> technique = workbench().makeTechnique("shadow-width");
    VisibilityBuffer visibility = workbench().frame().makeVisibility(moment.lights.front());
    const auto timesMadeWith = [&](std::uint64_t revision) {
        for (Caster& caster : casters) caster.alphaMask.revision = revision;
        technique->render(inputs, visibility);
        return technique->statistics().counts.at(1).value;
    };
    EXPECT_EQ(timesMadeWith(5), 1);
    EXPECT_EQ(timesMadeWith(5), 1);
    EXPECT_EQ(timesMadeWith(6), 2) << "other texels";
    EXPECT_EQ(timesMadeWith(0), 3);
    EXPECT_EQ(timesMadeWith(0), 4) << "unknown texels are never the same";
}

}  // namespace
}  // namespace penumbra::studio
