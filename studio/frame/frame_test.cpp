// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "src/gl/pass.h"
#include "studio/frame/conversions.h"
#include "studio/scene/builtin/builtin.h"
#include "studio/scene/builtin/placing.h"
#include "studio/scene/profiles/light_profile.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

/// As in unshadowed_test.comp.glsl.
struct Case {
    glm::vec4 pos;
    glm::vec4 normal;
    glm::vec4 size;
};

/// Irradiance of a flat light for a radiance of 1, by summing cos * cos / d^2 over a fine grid of its area.
double sumOverFlatLight(const Case& c, bool disk) {
    constexpr int n = 600;
    const glm::dvec3 pos(c.pos), normal(c.normal);
    const glm::dvec2 half = disk ? glm::dvec2(c.size.z) : glm::dvec2(c.size);
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const glm::dvec2 unit((i + 0.5) / n * 2 - 1, (j + 0.5) / n * 2 - 1);
            if (disk && glm::dot(unit, unit) > 1) continue;
            const glm::dvec3 towards = glm::dvec3(unit * half, 0) - pos;
            const double d2 = glm::dot(towards, towards);
            sum += std::max(0.0, glm::dot(normal, towards)) * std::abs(towards.z) / (d2 * d2);
        }
    }
    return sum * 4 * half.x * half.y / (double(n) * n);
}

/// The same for a cone of directions: a grid of equal solid angles.
double sumOverCone(const glm::dvec3& axis, const glm::dvec3& normal, double sine) {
    constexpr int n = 600;
    const double cosine = std::sqrt(1 - sine * sine);
    const glm::dvec3 side =
        glm::normalize(glm::cross(axis, std::abs(axis.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const glm::dvec3 other = glm::cross(axis, side);
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const double z = 1 - (i + 0.5) / n * (1 - cosine);
            const double r = std::sqrt(std::max(0.0, 1 - z * z));
            const double phi = (j + 0.5) / n * 2 * glm::pi<double>();
            const glm::dvec3 direction = z * axis + r * (std::cos(phi) * side + std::sin(phi) * other);
            sum += std::max(0.0, glm::dot(normal, direction));
        }
    }
    return sum * 2 * glm::pi<double>() * (1 - cosine) / (double(n) * n);
}

class UnshadowedTest : public TechniqueTest {
  protected:
    static void evaluate(std::vector<Case>& cases) {
        workbench().makeCurrent();
        gl::ShaderLibrary shaders{PENUMBRA_SOURCE_DIRECTORY};
        const gl::Program program(shaders, {"studio/frame/unshadowed_test.comp.glsl"});
        gl::Buffer buffer(std::as_bytes(std::span(cases)), "cases");
        gl::Pass(program).bind("Cases", buffer).dispatch(cases.size());
        buffer.read(std::as_writable_bytes(std::span(cases)));
    }

    /// Receivers in front of the light at random, facing anywhere: many have the light across their horizon.
    static std::vector<Case> randomCases(LightShape shape) {
        std::mt19937 random(7);
        std::uniform_real_distribution<float> unit(-1, 1);
        std::vector<Case> cases;
        while (cases.size() < 40) {
            const glm::vec3 pos(2 * unit(random), 2 * unit(random), -0.6f - 2 * std::abs(unit(random)));
            const glm::vec3 normal(unit(random), unit(random), unit(random));
            if (glm::length(normal) < 0.1f) continue;
            cases.push_back({glm::vec4(pos, float(shape)), glm::vec4(glm::normalize(normal), 0),
                             glm::vec4(0.4f, 0.25f, 0.5f, 0.3f)});
        }
        return cases;
    }
};

// Tolerances: of the quadratures above, 1e-3 of the light's own irradiance where the horizon cuts their
// grids.

TEST_F(UnshadowedTest, RectIsLambertsFormula) {
    // A 2 x 2 light at z = 2, seen from the axis: E = 0.75227 (closed form C8).
    std::vector<Case> axis = {{{0, 0, -2, 0}, {0, 0, 1, 0}, {1, 1, 0, 0}}};
    evaluate(axis);
    EXPECT_NEAR(axis[0].normal.w, 0.75227, 1e-4);

    std::vector<Case> cases = randomCases(LightShape::rect);
    evaluate(cases);
    for (const Case& c : cases) EXPECT_NEAR(c.normal.w, sumOverFlatLight(c, false), 1e-3);
}

TEST_F(UnshadowedTest, DiskOnAxisAndTilted) {
    // E = pi R^2 / (R^2 + H^2) (closed form C9).
    std::vector<Case> axis = {{{0, 0, -2, 1}, {0, 0, 1, 0}, {0, 0, 0.5f, 0}}};
    evaluate(axis);
    EXPECT_NEAR(axis[0].normal.w, glm::pi<double>() * 0.25 / 4.25, 2e-4);

    std::vector<Case> cases = randomCases(LightShape::disk);
    evaluate(cases);
    for (const Case& c : cases) EXPECT_NEAR(c.normal.w, sumOverFlatLight(c, true), 2e-3);
}

TEST_F(UnshadowedTest, SphereAndDistantAreConesOfDirections) {
    std::vector<Case> cases = randomCases(LightShape::sphere);
    evaluate(cases);
    for (const Case& c : cases) {
        const glm::dvec3 pos(c.pos);
        const double sine = c.size.z / glm::length(pos);
        EXPECT_NEAR(c.normal.w, sumOverCone(-glm::normalize(pos), glm::dvec3(c.normal), sine), 2e-3);
    }
    cases = randomCases(LightShape::distant);
    evaluate(cases);
    for (const Case& c : cases) {
        EXPECT_NEAR(c.normal.w, sumOverCone({0, 0, 1}, glm::dvec3(c.normal), std::sin(0.3)), 2e-3);
    }
}

/// The same of a tube along X, over its side.
double sumOverTube(const Case& c) {
    constexpr int n = 600;
    const glm::dvec3 pos(c.pos), normal(c.normal);
    const double length = 2.0 * c.size.x, radius = c.size.z;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * glm::pi<double>() * (i + 0.5) / n;
        const glm::dvec3 outward(0, std::cos(angle), std::sin(angle));
        for (int j = 0; j < n; ++j) {
            const glm::dvec3 point = radius * outward + glm::dvec3(length * ((j + 0.5) / n - 0.5), 0, 0);
            const glm::dvec3 towards = point - pos;
            const double d2 = glm::dot(towards, towards);
            sum += std::max(0.0, glm::dot(normal, towards)) * std::max(0.0, -glm::dot(outward, towards)) /
                   (d2 * d2);
        }
    }
    return sum * length * 2 * glm::pi<double>() * radius / (double(n) * n);
}

/// Of a tube's end at the distance d over a surface that faces its axis, l long from there on: what of a
/// hemisphere's irradiance it gives (D. C. Hamilton, W. R. Morgan, Radiant-interchange configuration factors,
/// NACA TN 2836, 1952).
double tubeFactor(double l, double r, double d) {
    const double D = d / r, L = l / r, A = (D + 1) * (D + 1) + L * L, B = (D - 1) * (D - 1) + L * L;
    const double pi = glm::pi<double>();
    return std::atan(L / std::sqrt(D * D - 1)) / (pi * D) +
           L / pi *
               ((A - 2 * D) / (D * std::sqrt(A * B)) * std::atan(std::sqrt(A * (D - 1) / (B * (D + 1)))) -
                std::atan(std::sqrt((D - 1) / (D + 1))) / D);
}

TEST_F(UnshadowedTest, TubesAreWithinHalfAPercentOfTheirClosedForm) {
    constexpr float shape = float(LightShape::cylinder);
    std::vector<Case> cases;
    std::vector<double> expected;
    for (const double radius : {0.004, 0.013, 0.1, 0.5}) {
        for (const double away : {1.05, 1.3, 2.0, 5.0, 30.0, 200.0}) {  // in radii
            for (const double length : {0.3, 1.2, 6.0}) {
                const double d = away * radius;
                // A receiver under the middle, and one under an end.
                for (const double x : {0.0, 0.5 * length}) {
                    cases.push_back(
                        {glm::vec4(x, 0, -d, shape), {0, 0, 1, 0}, glm::vec4(0.5 * length, 0, radius, 0)});
                    expected.push_back(glm::pi<double>() *
                                       (tubeFactor(0.5 * length + x, radius, d) +
                                        (x == 0 ? tubeFactor(0.5 * length, radius, d) : 0)));
                }
            }
        }
    }
    evaluate(cases);
    double worst = 0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        worst = std::max(worst, std::abs(cases[i].normal.w / expected[i] - 1));
        EXPECT_NEAR(cases[i].normal.w / expected[i], 1, 0.005)
            << "radius " << cases[i].size.z << ", " << -cases[i].pos.z << " m away, half of it "
            << cases[i].size.x << " m long";
    }
    RecordProperty("worst", std::to_string(worst));

    cases = randomCases(LightShape::cylinder);
    evaluate(cases);
    for (const Case& c : cases) {
        // Its own irradiance: of the sum of all that a receiver here could get.
        const double sum = sumOverTube(c);
        EXPECT_NEAR(c.normal.w, sum, 0.005 * sum + 1e-3);
    }
    // As far away as this it is a point whose candela go with the sine to its axis; turned about it, the
    // same.
    cases = {{{0, 0, -100, shape}, {0, 0, 1, 0}, {0.5f, 0, 0.1f, 0}},
             {{0, 100, 0, shape}, {0, -1, 0, 0}, {0.5f, 0, 0.1f, 0}},
             {{-60, 0, -80, shape}, {0.6f, 0, 0.8f, 0}, {0.5f, 0, 0.1f, 0}},
             {{-60, 48, -64, shape}, {0, 0, 1, 0}, {0.5f, 0, 0.1f, 0}},
             {{3, 0.05f, 0, shape}, {-1, 0, 0, 0}, {0.5f, 0, 0.1f, 0}}};
    evaluate(cases);
    EXPECT_NEAR(cases[0].normal.w, 0.2 * 1e-4, 1e-3 * 0.2e-4);
    EXPECT_NEAR(cases[1].normal.w, cases[0].normal.w, 1e-3 * 0.2e-4);
    EXPECT_NEAR(cases[2].normal.w, 0.8 * 0.2e-4, 1e-3 * 0.2e-4);
    EXPECT_NEAR(cases[3].normal.w, 0.64 * 0.8 * 0.2e-4, 1e-3 * 0.2e-4);
    EXPECT_EQ(cases[4].normal.w, 0) << "its ends are dark";
}

using FrameTest = TechniqueTest;

/// What a white floor reflects under a light is known in closed form.
Scene whiteFloorUnder(const Light& light) {
    Scene scene = makeBuiltin("half-plane");
    for (Material& material : scene.materials) material.baseColor = glm::vec4(1);
    return withMoment(std::move(scene), [light](SceneMoment& moment) {
        moment.lights = {light};
        moment.cameras.erase(moment.cameras.begin());  // leaves the one that looks straight down
        std::erase_if(moment.instances, [](const Instance& instance) { return !isGround(instance); });
    });
}

double centerRadiance_nits(const Scene& scene) {
    const std::unique_ptr<Technique> hard = TechniqueTest::workbench().makeTechnique("hard");
    const SceneMoment moment = scene.at(0);
    auto& workbench = TechniqueTest::workbench();
    workbench.open(scene);
    return workbench.run("hard", *hard, moment, moment.cameras.front(), {33, 33}).radiance.at(16, 16, 1);
}

TEST_F(FrameTest, RadianceIsInNits) {
    // A receiver under the middle of a light of radiance L at 4 m reflects E / pi.
    Light disk = diskLight("disk", 0.5f, {0, 4, 0}, {0, 0, 0}, 1);
    disk.emission = {Emission::Unit::nits, glm::vec3(1000)};
    EXPECT_NEAR(centerRadiance_nits(whiteFloorUnder(disk)), 1000 * 0.25 / (0.25 + 16), 0.1);

    Light point = sphereLight("point", 0, {0, 4, 0}, {0, 0, 0}, 1);
    point.emission = {Emission::Unit::candela, glm::vec3(160)};
    EXPECT_NEAR(centerRadiance_nits(whiteFloorUnder(point)), 160 / 16.0 / glm::pi<double>(), 0.01);

    Light sun = distantLight("sun", 0, {0, -1, 0}, 1);
    sun.emission = {Emission::Unit::lux, glm::vec3(100)};
    EXPECT_NEAR(centerRadiance_nits(whiteFloorUnder(sun)), 100 / glm::pi<double>(), 0.1);
}

TEST_F(FrameTest, SpotsFallOffBetweenTheirCones) {
    Light spot = diskLight("spot", 0.1f, {0, 4, 0}, {0, 0, 0}, 1000);
    const double inFull = centerRadiance_nits(whiteFloorUnder(spot));
    spot.cone_rad = {0.3f, 0.5f};
    EXPECT_NEAR(centerRadiance_nits(whiteFloorUnder(spot)), inFull, 1e-3 * inFull);
    // Turned away by an angle between the two, then beyond both.
    const auto turned = [&](double angle_rad) {
        Light light = diskLight("spot", 0.1f, {0, 4, 0}, {float(4 * std::tan(angle_rad)), 0, 0}, 1000);
        light.emission = spot.emission;
        light.cone_rad = spot.cone_rad;
        return centerRadiance_nits(whiteFloorUnder(light));
    };
    EXPECT_LT(turned(0.4), 0.9 * inFull);
    EXPECT_GT(turned(0.4), 0);
    EXPECT_EQ(turned(0.6), 0);
}

TEST_F(FrameTest, LightsAddUp) {
    const Scene one = makeBuiltin("primitives");
    const Scene two = withMoment(makeBuiltin("primitives"),
                                 [](SceneMoment& moment) { moment.lights.push_back(moment.lights.front()); });
    const auto radianceOf = [&](const Scene& scene) {
        const std::unique_ptr<Technique> hard = workbench().makeTechnique("hard");
        const SceneMoment moment = scene.at(0);
        workbench().open(scene);
        return workbench().run("hard", *hard, moment, moment.cameras.front(), defaultSize).radiance;
    };
    const Image single = radianceOf(one), both = radianceOf(two);
    for (std::size_t i = 0; i < single.values.size(); ++i) {
        ASSERT_NEAR(both.values[i], 2 * single.values[i], 1e-4f * single.values[i]);
    }
}

TEST_F(FrameTest, PicturesAreUpright) {
    // The ground of this scene fills the lower rows, the sky's background the upper.
    const std::unique_ptr<Technique> hard = workbench().makeTechnique("hard");
    const Scene scene = makeBuiltin("primitives");
    const SceneMoment moment = scene.at(0);
    workbench().open(scene);
    const TechniqueResult result =
        workbench().run("hard", *hard, moment, moment.cameras.front(), defaultSize);
    const auto& radiance = result.radiance;
    EXPECT_EQ(radiance.at(radiance.width_px / 2, 0, 1), 0);
    EXPECT_GT(radiance.at(radiance.width_px / 2, radiance.height_px - 1, 1), 0);
}

TEST_F(FrameTest, SceneWithoutLightsIsDarkButShown) {
    const Scene scene =
        withMoment(makeBuiltin("primitives"), [](SceneMoment& moment) { moment.lights.clear(); });
    const std::unique_ptr<Technique> hard = workbench().makeTechnique("hard");
    const SceneMoment moment = scene.at(0);
    workbench().open(scene);
    const TechniqueResult result =
        workbench().run("hard", *hard, moment, moment.cameras.front(), defaultSize);
    EXPECT_TRUE(result.lights.empty());
    for (const float value : result.display.values) ASSERT_TRUE(value >= 0 && value <= 1);
}

/// A lamp with a lobe, a cut-off and nothing above; all planes differ.
std::shared_ptr<const LightProfile> lobedProfile() {
    LightProfile profile;
    CandelaGrid& grid = profile.grid;
    for (int gamma = 0; gamma <= 90; gamma += 5) grid.verticals_deg.push_back(gamma);
    for (int c = 0; c <= 360; c += 30) grid.horizontals_deg.push_back(c);
    for (const double c : grid.horizontals_deg)
        for (const double gamma : grid.verticals_deg)
            grid.candela.push_back(
                gamma > 60 ? 0 : float(500 + gamma * (10 + 3 * std::sin(glm::radians(c + 20)))));
    return std::make_shared<LightProfile>(profile);
}

/// A light of that profile which hangs at a height over a place beside the floor's middle.
Light profiledLight(const AreaLight& shape, bool isLuminaire, double height_m, double beside_m) {
    Light light = diskLight("lamp", 1, {float(beside_m), float(height_m), 0}, {float(beside_m), 0, 0}, 1);
    const Mat4 place = light.shape.worldFromLight;
    light.shape = shape;
    light.shape.worldFromLight = place;
    light.emission = {isLuminaire ? Emission::Unit::candela : Emission::Unit::nits, glm::vec3(1)};
    light.profile = {.profile = lobedProfile(), .isLuminaire = isLuminaire, .turn_rad = 0.4f};
    return light;
}

/// Lux on the floor's middle by summing over a fine grid of the light, in double precision.
double summedLux(const Light& light) {
    constexpr int n = 400;
    const glm::dmat4 worldFromLight = fromPenumbra(light.shape.worldFromLight);
    const glm::dvec3 pos(glm::inverse(worldFromLight) * glm::dvec4(0, 0, 0, 1));
    const glm::dvec3 normal = glm::transpose(glm::dmat3(worldFromLight)) * glm::dvec3(0, 1, 0);
    const bool rect = light.shape.shape == LightShape::rect, sphere = light.shape.shape == LightShape::sphere;
    const glm::dvec2 half =
        rect ? 0.5 * glm::dvec2(light.shape.width_m, light.shape.height_m) : glm::dvec2(light.shape.radius_m);
    glm::dvec3 x(1, 0, 0), y(0, 1, 0);
    if (sphere) {
        x = glm::normalize(glm::cross(pos, glm::dvec3(1, 0, 0)));
        y = glm::normalize(glm::cross(pos, x));
    }
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1), -double(light.profile->turn_rad), glm::dvec3(0, 0, 1)));
    const bool isLuminaire = light.emission.unit == Emission::Unit::candela;
    double sum = 0, area = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const glm::dvec2 unit((i + 0.5) / n * 2 - 1, (j + 0.5) / n * 2 - 1);
            if (!rect && glm::dot(unit, unit) > 1) continue;
            const glm::dvec3 towards = unit.x * half.x * x + unit.y * half.y * y - pos;
            const glm::dvec3 direction = glm::normalize(towards);
            const double cosine = std::max(0.0, glm::dot(normal, direction)) / glm::dot(towards, towards);
            const double atLight = isLuminaire || sphere ? 1 : std::abs(direction.z);
            sum += light.profile->profile->grid.at(turn * -direction) * cosine * atLight;
            area += 1;
        }
    const double area_m2 = rect ? 4 * half.x * half.y : glm::pi<double>() * half.x * half.x;
    return sum / area * (isLuminaire ? 1 : area_m2);
}

/// The same of a tube: candela by the share of what it shows from the floor's middle, luminance over its
/// side.
double summedLuxOfTube(const Light& light) {
    constexpr int n = 400;
    const glm::dmat4 worldFromLight = fromPenumbra(light.shape.worldFromLight);
    const glm::dvec3 pos(glm::inverse(worldFromLight) * glm::dvec4(0, 0, 0, 1));
    const glm::dvec3 normal = glm::transpose(glm::dmat3(worldFromLight)) * glm::dvec3(0, 1, 0);
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1), -double(light.profile->turn_rad), glm::dvec3(0, 0, 1)));
    const bool isLuminaire = light.emission.unit == Emission::Unit::candela;
    const double length = light.shape.length_m, radius = light.shape.radius_m;
    const double away = std::hypot(pos.y, pos.z), outermost = std::acos(radius / away);
    const glm::dvec3 nearest = glm::dvec3(0, pos.y, pos.z) / away,
                     aside = glm::cross(nearest, glm::dvec3(1, 0, 0));
    double sum = 0, share = 0;
    for (int i = 0; i < n; ++i) {
        const double angle = outermost * (2 * (i + 0.5) / n - 1);
        const glm::dvec3 outward = std::cos(angle) * nearest + std::sin(angle) * aside;
        const double width = std::cos(angle);  // of a line's as it looks from far off
        for (int j = 0; j < n; ++j) {
            const glm::dvec3 towards =
                radius * outward + glm::dvec3(length * ((j + 0.5) / n - 0.5), 0, 0) - pos;
            const glm::dvec3 direction = glm::normalize(towards);
            const double cosine = std::max(0.0, glm::dot(normal, direction)) / glm::dot(towards, towards);
            const double part = isLuminaire ? width : std::max(0.0, -glm::dot(outward, direction));
            sum += light.profile->profile->grid.at(turn * -direction) * cosine * part;
            share += width;
        }
    }
    return isLuminaire ? sum / share : sum * length * 2 * outermost * radius / (double(n) * n);
}

double centerLux(const Light& light) {
    return glm::pi<double>() * centerRadiance_nits(whiteFloorUnder(light));
}

TEST_F(FrameTest, LuminairesAreCandelaFromAfar) {
    const AreaLight panel{.shape = LightShape::rect, .width_m = 0.6f, .height_m = 0.3f};
    // Not straight below: candela has a ridge there, over which the panel is no point however far it is.
    for (const double beside_m : {1.5, 2.5}) {
        const Light light = profiledLight(panel, true, 4, beside_m);  // beyond five times its size
        const double distance2 = 16 + beside_m * beside_m;
        const glm::dmat3 turn(glm::rotate(glm::dmat4(1), -0.4, glm::dvec3(0, 0, 1)));
        const glm::dvec3 down =
            glm::transpose(glm::dmat3(glm::dmat4(fromPenumbra(light.shape.worldFromLight)))) *
            glm::dvec3(-beside_m, -4, 0);
        const double candela = light.profile->profile->grid.at(turn * down);
        const double farField = candela * 4 / std::sqrt(distance2) / distance2;
        EXPECT_NEAR(centerLux(light), farField, 0.01 * farField) << beside_m;
    }
}

TEST_F(FrameTest, ProfilesShapeLightsOfAnyShape) {
    const AreaLight shapes[] = {{.shape = LightShape::rect, .width_m = 1.2f, .height_m = 0.3f},
                                {.shape = LightShape::disk, .radius_m = 0.5f},
                                {.shape = LightShape::sphere, .radius_m = 0.3f},
                                {.shape = LightShape::cylinder, .length_m = 1.2f, .radius_m = 0.013f},
                                {.shape = LightShape::cylinder, .length_m = 0.8f, .radius_m = 0.2f}};
    for (const AreaLight& shape : shapes)
        for (const bool isLuminaire : {true, false})
            for (const double height_m : {0.5, 1.0, 2.0, 5.0})
                for (const double beside_m : {0.0, 0.7}) {
                    const Light light = profiledLight(shape, isLuminaire, height_m, beside_m);
                    const double right =
                        shape.shape == LightShape::cylinder ? summedLuxOfTube(light) : summedLux(light);
                    EXPECT_NEAR(centerLux(light), right, 0.02 * right)
                        << int(shape.shape) << " " << isLuminaire << " " << height_m << " " << beside_m;
                }
}

TEST_F(FrameTest, ProfilesOfAllTypesAreReadAsOnTheCpu) {
    // A point: what it sends is the grid's own value.
    const auto check = [](const CandelaGrid& grid, const char* what) {
        LightProfile profile;
        profile.grid = grid;
        Light light = profiledLight({.shape = LightShape::sphere}, true, 3, 0);
        for (const glm::vec3 aim : {glm::vec3(0.4f, 0, 0.3f), glm::vec3(2, 0, 1), glm::vec3(-1, 0, 3),
                                    glm::vec3(-4, 0, -2), glm::vec3(1, 3.5, 2)}) {
            light = diskLight("lamp", 1, {0, 3, 0}, aim, 1);
            const Mat4 place = light.shape.worldFromLight;
            light.shape = {.shape = LightShape::sphere};
            light.shape.worldFromLight = place;
            light.emission = {Emission::Unit::candela, glm::vec3(1)};
            light.profile = {.profile = std::make_shared<LightProfile>(profile)};
            const glm::dvec3 down =
                glm::transpose(glm::dmat3(glm::dmat4(fromPenumbra(place)))) * glm::dvec3(0, -1, 0);
            const double right = grid.at(down) / 9;
            EXPECT_NEAR(centerLux(light), right, 1e-3 * grid.largest() / 9)
                << what << " " << aim.x << " " << aim.z;
        }
    };
    const auto filled = [](CandelaGrid grid) {
        for (std::size_t i = 0; i < grid.verticals_deg.size() * grid.horizontals_deg.size(); ++i)
            grid.candela.push_back(100 + float(i * 37 % 101));
        return grid;
    };
    using Type = CandelaGrid::Type;
    check(filled({.type = Type::C, .verticals_deg = {0, 20, 50, 90, 130, 180}, .horizontals_deg = {0}}),
          "one plane");
    check(filled({.type = Type::C, .verticals_deg = {0, 45, 180}, .horizontals_deg = {0, 30, 90}}),
          "quarter");
    check(filled({.type = Type::C,
                  .verticals_deg = {0, 45, 180},
                  .horizontals_deg = {0, 90, 180},
                  .firstPlane_deg = 90}),
          "half");
    check(filled({.type = Type::C,
                  .verticals_deg = {0, 45, 100},
                  .horizontals_deg = {0, 100, 360},
                  .firstPlane_deg = 20}),
          "whole");
    check(filled({.type = Type::B, .verticals_deg = {-90, -10, 30, 90}, .horizontals_deg = {-90, 0, 40, 90}}),
          "B");
    check(filled({.type = Type::B, .verticals_deg = {-90, -10, 30, 90}, .horizontals_deg = {0, 40, 90}}),
          "B mirrored");
    check(
        filled({.type = Type::A, .verticals_deg = {-90, -10, 30, 90}, .horizontals_deg = {-180, 0, 40, 180}}),
        "A");
}

}  // namespace
}  // namespace penumbra::studio
