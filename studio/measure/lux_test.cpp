// SPDX-License-Identifier: Apache-2.0
// Lux against what is known: closed forms, sums, symmetries, and integrals by hand.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "studio/frame/conversions.h"
#include "studio/measure/measurement.h"
#include "studio/scene/builtin/builtin.h"
#include "studio/scene/builtin/mesh_kit.h"
#include "studio/scene/builtin/placing.h"
#include "studio/scene/builtin/scene_builder.h"
#include "studio/scene/profiles/light_profile.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

using std::numbers::pi;

/// How near closed forms are to be met.
constexpr double tolerance = 0.005;

class LuxTest : public TechniqueTest {
  protected:
    static PointSet at(const std::vector<MeasuringPoint>& points) {
        PointSet set;
        set.points = points;
        for (MeasuringPoint& point : set.points) point.row = set.rows++;
        return set;
    }

    static Measurement measureWith(std::string_view technique, const Scene& scene, PointSet set,
                                   const Settings& settings = {{"samples", "1024"},
                                                               {"weight", "irradiance"}}) {
        const SceneMoment moment = scene.at(0);
        const auto made = workbench().makeTechnique(technique);
        for (const auto& [key, value] : settings) setParameter(*made, key, value);
        workbench().open(scene);
        Measurement measurement = prepare(scene, moment, std::move(set), {.perLight = true});
        measure(measurement, workbench(), moment, *made, {.perLight = true});
        return measurement;
    }
    static Measurement measureAt(const Scene& scene, const std::vector<MeasuringPoint>& points) {
        return measureWith("exact", scene, at(points));
    }
    static double luxAt(const Scene& scene, const glm::dvec3& place, const glm::dvec3& normal = {0, 1, 0}) {
        return measureAt(scene, {{place, normal}}).values[0].lux;
    }
};

constexpr float height_m = 2;
constexpr float luminance = 5000;

/// Shines down from `height_m` above the origin.
Light downwards(LightShape shape) {
    Light light = rectLight("key", 1, 1, {0, height_m, 0}, {0, 0, 0}, 1);
    light.shape.shape = shape;
    light.emission = {Emission::Unit::nits, glm::vec3(luminance)};
    return light;
}

SceneBuilder withGround(const Light& light) {
    SceneBuilder scene("closed form");
    scene.ground(20);
    scene.light(light);
    return scene;
}

/// Illuminance below the corner of a rectangle of a x b at height h that shines down (Lambert 1760).
double belowCorner(double a, double b, double h) {
    const double alongA = std::hypot(a, h), alongB = std::hypot(b, h);
    return luminance / 2 * (a / alongA * std::atan(b / alongA) + b / alongB * std::atan(a / alongB));
}

TEST_F(LuxTest, BelowADisk) {
    Light disk = downwards(LightShape::disk);
    disk.shape.radius_m = 0.4f;
    const double truth = pi * luminance * 0.16 / (0.16 + height_m * height_m);
    EXPECT_NEAR(luxAt(withGround(disk).build(), {0, 0, 0}), truth, tolerance * truth);
}

TEST_F(LuxTest, BelowARectangle) {
    Light rect = downwards(LightShape::rect);
    rect.shape.width_m = 1.2f;
    rect.shape.height_m = 0.6f;
    const Scene scene = withGround(rect).build();
    const double truth = 4 * belowCorner(0.6, 0.3, height_m);
    EXPECT_NEAR(luxAt(scene, {0, 0, 0}), truth, tolerance * truth);
    const double corner = belowCorner(1.2, 0.6, height_m);
    EXPECT_NEAR(luxAt(scene, {0.6, 0, 0.3}), corner, tolerance * corner);
}

TEST_F(LuxTest, OfASphereOverAPlane) {
    Light ball = downwards(LightShape::sphere);
    ball.shape.radius_m = 0.3f;
    const Scene scene = withGround(ball).build();
    for (const double x : {0.0, 1.0, 3.0}) {
        const double distance = std::hypot(x, double(height_m));
        const double truth = pi * luminance * 0.09 / (distance * distance) * height_m / distance;
        EXPECT_NEAR(luxAt(scene, {x, 0, 0}), truth, tolerance * truth) << x;
    }
}

TEST_F(LuxTest, OfATubeOverAPlane) {
    Light tube = downwards(LightShape::cylinder);
    tube.shape.length_m = 1.2f;
    tube.shape.radius_m = 0.05f;
    const Scene scene = withGround(tube).build();
    for (const glm::dvec3 point : {glm::dvec3(0, 0, 0), glm::dvec3(0.5, 0, 0.7), glm::dvec3(1.5, 0, 0.2)}) {
        // The integral over its side, whose ends are open.
        constexpr int alongs = 600, arounds = 400;
        double truth = 0;
        for (int a = 0; a < alongs; ++a) {
            for (int b = 0; b < arounds; ++b) {
                const double angle = 2 * pi * (b + 0.5) / arounds;
                const glm::dvec3 normal(0, std::cos(angle), std::sin(angle));
                const glm::dvec3 from =
                    glm::dvec3(1.2 * ((a + 0.5) / alongs - 0.5), height_m, 0) + 0.05 * normal;
                const glm::dvec3 away = point - from;
                const double distance2 = glm::dot(away, away), leaves = glm::dot(normal, away);
                if (leaves > 0 && away.y < 0) truth += luminance * leaves * -away.y / (distance2 * distance2);
            }
        }
        truth *= 1.2 * 2 * pi * 0.05 / (alongs * arounds);
        EXPECT_NEAR(luxAt(scene, point), truth, tolerance * truth) << point.x;
    }
}

TEST_F(LuxTest, HalfBehindAPane) {
    Light rect = downwards(LightShape::rect);
    rect.shape.width_m = 1.2f;
    rect.shape.height_m = 0.6f;
    SceneBuilder scene = withGround(rect);
    // Below the half of the light that lies towards +X, seen from the origin.
    scene.place("pane", scene.mesh("pane", plane(2, 2), glm::vec3(1)), studio::at({1, 1, 0}));
    const glm::vec3 passes(0.5f, 0.8f, 0.25f);
    const Scene behind = withMoment(std::move(scene).build(), [&](SceneMoment& moment) {
        moment.instances.back().transmittance = passes;
    });
    const double luminanceThatPasses = glm::dot(passes, glm::vec3(0.2126f, 0.7152f, 0.0722f));
    const double open = 4 * belowCorner(0.6, 0.3, height_m), truth = open * (1 + luminanceThatPasses) / 2;
    const Settings few = {{"samples", "64"}, {"weight", "irradiance"}};
    const Measurement measured = measureWith("exact", behind, at({{{0, 0, 0}, {0, 1, 0}}}), few);
    // One sample of the 64 may lie at the pane's edge.
    const double ofSample = open * (1 - luminanceThatPasses) / 64;
    EXPECT_NEAR(measured.values[0].lux, truth, tolerance * truth + ofSample);
}

TEST_F(LuxTest, ProgressGoesOnToItsEnd) {
    const Scene scene = makeBuiltin("many-lights");
    const SceneMoment moment = scene.at(0);
    const auto technique = workbench().makeTechnique("exact");
    workbench().open(scene);
    std::vector<double> shares;
    const MeasuringOptions options{.progress = [&](double share) { shares.push_back(share); }};
    Measurement measurement =
        prepare(scene, moment, planeGrid({{-1, 0.01, -1}, 2, 2}, 8, 8, scene, moment), options);
    measure(measurement, workbench(), moment, *technique, options);
    EXPECT_GE(shares.size(), moment.lights.size());
    EXPECT_TRUE(std::ranges::is_sorted(shares));
    EXPECT_NEAR(shares.back(), 1, 1e-9);

    const Measurement::Cost cost = timeRuns(measurement, workbench(), moment, *technique, options, 3);
    EXPECT_EQ(cost.runs_ms.size(), 3u);
    EXPECT_GT(std::ranges::min(cost.runs_ms), 0);
}

TEST_F(LuxTest, OfAHalfHiddenRectangle) {
    Light rect = downwards(LightShape::rect);
    SceneBuilder scene = withGround(rect);
    scene.place("sheet", scene.mesh("sheet", plane(8, 16), glm::vec3(0.5f)),
                penumbra::studio::at({-4, 1, 0}));
    const Scene built = std::move(scene).build();
    // Below the edge, just what is right of it is seen; elsewhere what the edge, seen from there, leaves.
    for (const double x : {0.0, 0.1, -0.1, 0.2}) {
        const double edge = -x;  // on the light, twice as high as the sheet
        const auto part = [&](double from) {
            return belowCorner(std::abs(from), 0.5, height_m) * (from < 0 ? -1 : 1);
        };
        const double right = 0.5, seenFrom = std::clamp(edge, -0.5, 0.5);
        const double truth = 2 * (part(right - x) - part(seenFrom - x));
        EXPECT_NEAR(luxAt(built, {x, 0, 0}), truth, tolerance * truth) << x;
    }
}

/// Of a ball the 1,024 samples lie less evenly about an edge through its very middle.
constexpr double toleranceOfBalls = 0.01;

TEST_F(LuxTest, OfAHalfHiddenDiskAndSphere) {
    Light disk = downwards(LightShape::disk);
    disk.shape.radius_m = 0.4f;
    Light ball = downwards(LightShape::sphere);
    ball.shape.radius_m = 0.3f;
    for (const auto& [light, within] : {std::pair(disk, tolerance), {ball, toleranceOfBalls}}) {
        SceneBuilder scene = withGround(light);
        scene.place("sheet", scene.mesh("sheet", plane(8, 16), glm::vec3(0.5f)),
                    penumbra::studio::at({-4, 1, 0}));
        const Measurement measured = measureAt(std::move(scene).build(), {{{0, 0, 0}}});
        const double whole = luxAt(withGround(light).build(), {0, 0, 0});
        EXPECT_NEAR(measured.values[0].lux, whole / 2, within * whole / 2);
        EXPECT_LE(std::abs(measured.values[0].lux - whole / 2), measured.values[0].bound_lux);
    }
}

TEST_F(LuxTest, OfASunOnATiltedPlane) {
    const Light sun = distantLight("sun", 0.0093f, {1, -1, 0}, 80000);
    const Scene scene = withGround(sun).build();
    EXPECT_NEAR(luxAt(scene, {0, 0, 0}), 80000 * std::sqrt(0.5), 80000 * tolerance);
    EXPECT_NEAR(luxAt(scene, {0, 1, 0}, {-1, 1, 0}), 80000, 80000 * tolerance);
    EXPECT_EQ(luxAt(scene, {0, 1, 0}, {1, 0, 0}), 0);
}

TEST_F(LuxTest, OfASunBehindAnEdgeIsWithinItsBound) {
    constexpr float angle_rad = 0.0093f;
    constexpr double ofASample = 80000.0 / 1024;  // what is finer is in no bound
    SceneBuilder scene = withGround(distantLight("sun", angle_rad, {0, -1, 0}, 80000));
    scene.place("sheet", scene.mesh("sheet", plane(8, 16), glm::vec3(0.5f)),
                penumbra::studio::at({-4, 1, 0}));
    const double radius = std::tan(0.5 * double(angle_rad));  // on the ground, of the half-shadow
    std::vector<MeasuringPoint> points;
    constexpr int count = 1000;
    for (int i = 0; i < count; ++i) points.push_back({{1.2 * radius * (2.0 * i / count - 1), 0, 0.1}});
    const Measurement measured = measureAt(std::move(scene).build(), points);
    int outside = 0, ofHalfShadow = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double beyond = std::clamp(-points[i].posWorld.x / radius, -1.0, 1.0);
        const double seen = (std::acos(beyond) - beyond * std::sqrt(1 - beyond * beyond)) / pi;
        const MeasuredValue& value = measured.values[i];
        if (value.bound_lux > 0) ++ofHalfShadow;
        if (std::abs(double(value.lux) - 80000 * seen) > double(value.bound_lux) + ofASample) ++outside;
    }
    EXPECT_GT(ofHalfShadow, count / 2);
    EXPECT_LE(outside, count / 1000);
}

TEST_F(LuxTest, IsTheSumOverLights) {
    const Scene scene = makeBuiltin("many-lights");
    const Measurement measured =
        measureWith("exact", scene, planeGrid({{-1, 0.01, -1}, 2, 2}, 8, 8, scene, scene.at(0)));
    ASSERT_EQ(measured.lights.size(), scene.at(0).lights.size());
    for (std::size_t i = 0; i < measured.values.size(); ++i) {
        double sum = 0;
        for (const Measurement::OfLight& light : measured.lights) sum += double(light.lux[i]);
        EXPECT_NEAR(measured.values[i].lux, sum, 1e-4 * sum + 1e-6);
    }
}

TEST_F(LuxTest, OfTheReferenceAgreesWithinTheBounds) {
    const Scene scene = makeBuiltin("many-lights");
    const PointSet set = planeGrid({{-1.5, 0.002, -1.5}, 3, 3}, 32, 32, scene, scene.at(0));
    const Measurement exact = measureWith("exact", scene, set);
    const Measurement truth = measureWith(
        "reference", scene, set, {{"samples", "4096"}, {"weight", "irradiance"}, {"cache", "false"}});
    int outside = 0, counted = 0;
    for (std::size_t i = 0; i < exact.values.size(); ++i) {
        if (!exact.counts(i)) continue;
        ++counted;
        const double difference = std::abs(double(exact.values[i].lux) - double(truth.values[i].lux));
        const double bound = double(exact.values[i].bound_lux) + double(truth.values[i].bound_lux);
        if (difference > bound + 1e-3 * double(truth.values[i].lux)) ++outside;
    }
    EXPECT_GT(counted, 500);
    EXPECT_LE(outside, counted / 1000 + 1);
}

/// A luminaire whose candela fall steeply beyond 30 degrees.
std::shared_ptr<const LightProfile> steepProfile() {
    auto profile = std::make_shared<LightProfile>();
    for (int gamma = 0; gamma <= 90; gamma += 5) {
        profile->grid.verticals_deg.push_back(gamma);
        const double cut = 1 / (1 + std::exp((gamma - 30) / 3.0));
        profile->grid.candela.push_back(float(1000 * std::cos(glm::radians(double(gamma))) * cut));
    }
    profile->grid.verticals_deg.push_back(180);
    profile->grid.candela.push_back(0);
    profile->grid.horizontals_deg = {0};
    return profile;
}

/// One whose angles are evenly spaced.
std::shared_ptr<const LightProfile> evenProfile() {
    auto profile = std::make_shared<LightProfile>();
    for (int plane = 0; plane <= 90; plane += 30) profile->grid.horizontals_deg.push_back(plane);
    for (int gamma = 0; gamma <= 90; gamma += 5) profile->grid.verticals_deg.push_back(gamma);
    for (const double plane_deg : profile->grid.horizontals_deg) {
        for (const double gamma_deg : profile->grid.verticals_deg) {
            const double cosine = std::max(std::cos(glm::radians(gamma_deg)), 0.0);
            profile->grid.candela.push_back(float(1000 * std::pow(cosine, 2 + plane_deg / 45)));
        }
    }
    return profile;
}

/// `exact` answers for all of a panel's cells at once, the reference for parts of it by themselves.
TEST_F(LuxTest, CellsOfAPanelSendWhatItsPartsDo) {
    SceneBuilder scene("panel");
    scene.ground(20);
    scene.place("sheet", scene.mesh("sheet", plane(8, 16), glm::vec3(0.5f)),
                penumbra::studio::at({-4, 1, 0}));
    Light panel = rectLight("panel", 0.9f, 0.9f, {0.2f, height_m, 0}, {0.2f, 0, 0}, 1);
    panel.emission = {Emission::Unit::candela, glm::vec3(1)};
    panel.profile = ProfiledEmission{.profile = evenProfile(), .isLuminaire = true};
    scene.light(panel);
    std::vector<MeasuringPoint> points;
    for (int i = 0; i < 24; ++i) points.push_back({{-0.9 + 0.07 * i, 0, 0.1 * (i % 5) - 0.2}});
    const Scene built = std::move(scene).build();
    const Measurement exact = measureAt(built, points);
    const Measurement truth = measureWith(
        "reference", built, at(points), {{"samples", "16384"}, {"weight", "irradiance"}, {"cache", "false"}});
    for (std::size_t i = 0; i < points.size(); ++i) {
        const MeasuredValue &seen = exact.values[i], &rays = truth.values[i];
        EXPECT_NEAR(seen.lux, rays.lux, double(seen.bound_lux + rays.bound_lux) + 1e-3 * double(rays.lux))
            << points[i].posWorld.x;
    }
    EXPECT_GT(truth.values.back().lux, 10 * truth.values[4].lux) << "the sheet hides nothing";
}

TEST_F(LuxTest, OfFourPanelsWithAProfileBehindAnEdgeIsTheirIntegral) {
    const auto profile = steepProfile();
    SceneBuilder scene("office");
    scene.ground(20);
    scene.place("sheet", scene.mesh("sheet", plane(8, 16), glm::vec3(0.5f)),
                penumbra::studio::at({-4, 1, 0}));
    std::vector<glm::dvec3> middles;
    for (const float x : {-0.6f, 0.6f}) {
        for (const float z : {-0.6f, 0.6f}) {
            Light panel = rectLight("panel", 0.6f, 0.6f, {x, height_m, z}, {x, 0, z}, 1);
            panel.name += std::to_string(middles.size());
            panel.emission = {Emission::Unit::candela, glm::vec3(1)};
            panel.profile = ProfiledEmission{.profile = profile, .isLuminaire = true};
            scene.light(panel);
            middles.emplace_back(x, height_m, z);
        }
    }
    std::vector<MeasuringPoint> points;
    for (const double x : {-0.5, -0.2, 0.0, 0.13, 0.4, 1.0, 1.7}) points.push_back({{x, 0, 0.1}});
    const Measurement measured = measureAt(std::move(scene).build(), points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec3 point = points[i].posWorld;
        constexpr int parts = 400;
        double truth = 0;
        for (const glm::dvec3& middle : middles) {
            for (int a = 0; a < parts; ++a) {
                for (int b = 0; b < parts; ++b) {
                    const glm::dvec3 from = middle + glm::dvec3(0.6 * ((a + 0.5) / parts - 0.5), 0,
                                                                0.6 * ((b + 0.5) / parts - 0.5));
                    // What passes the sheet's height left of its edge is hidden.
                    if (0.5 * (from.x + point.x) < 0) continue;
                    const glm::dvec3 away = point - from;
                    const double distance = glm::length(away), cosine = -away.y / distance;
                    const double candela = profile->grid.at({away.x, away.z, away.y});
                    truth += candela * cosine / (distance * distance) / (parts * parts);
                }
            }
        }
        EXPECT_NEAR(measured.values[i].lux, truth, 0.01 * truth + 0.02) << points[i].posWorld.x;
    }
}

}  // namespace
}  // namespace penumbra::studio
