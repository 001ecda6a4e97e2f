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
#include "studio/scene/profiles/luminaire.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

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

constexpr int pictureWidth_px = 33;

Image smallPicture(const Scene& scene) {
    const std::unique_ptr<Technique> hard = TechniqueTest::workbench().makeTechnique("hard");
    const SceneMoment moment = scene.at(0);
    auto& workbench = TechniqueTest::workbench();
    workbench.open(scene);
    return workbench.run("hard", *hard, moment, moment.cameras.front(), {pictureWidth_px, pictureWidth_px})
        .radiance;
}

double centerRadiance_nits(const Scene& scene) {
    return smallPicture(scene).at(pictureWidth_px / 2, pictureWidth_px / 2, 1);
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

/// From the light's own axes to those that its candela are told in.
glm::dmat3 profileFromShape(const Light& light) {
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1), -double(light.profile->turn_rad), glm::dvec3(0, 0, 1));
    return glm::dmat3(turn) * glm::dmat3(light.profile->luminaireFromShape);
}

/// Lux on the floor, in its middle unless told, by summing over a fine grid of n x n points of the light, in
/// double precision.
double summedLux(const Light& light, const glm::dvec3& place = {0, 0, 0}, int n = 400) {
    const glm::dmat4 worldFromLight = fromPenumbra(light.shape.worldFromLight);
    const glm::dvec3 pos(glm::inverse(worldFromLight) * glm::dvec4(place, 1));
    const glm::dvec3 normal = glm::transpose(glm::dmat3(worldFromLight)) * glm::dvec3(0, 1, 0);
    const bool rect = light.shape.shape == LightShape::rect, sphere = light.shape.shape == LightShape::sphere;
    const glm::dvec2 half =
        rect ? 0.5 * glm::dvec2(light.shape.width_m, light.shape.height_m) : glm::dvec2(light.shape.radius_m);
    glm::dvec3 x(1, 0, 0), y(0, 1, 0);
    if (sphere) {
        x = glm::normalize(glm::cross(pos, glm::dvec3(1, 0, 0)));
        y = glm::normalize(glm::cross(pos, x));
    }
    const glm::dmat3 turn = profileFromShape(light);
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
    const glm::dmat3 turn = profileFromShape(light);
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
    // All 0.8 m at most; they hang five times that away and more.
    const AreaLight shapes[] = {{.shape = LightShape::rect, .width_m = 0.6f, .height_m = 0.3f},
                                {.shape = LightShape::disk, .radius_m = 0.4f},
                                {.shape = LightShape::sphere, .radius_m = 0.4f},
                                {.shape = LightShape::cylinder, .length_m = 0.8f, .radius_m = 0.02f}};
    for (const AreaLight& shape : shapes) {
        // Not straight below: candela has a ridge there, over which the panel is no point however far it is.
        for (const double beside_m : {1.5, 2.5}) {
            const Light light = profiledLight(shape, true, 4, beside_m);
            const double distance2 = 16 + beside_m * beside_m;
            const glm::dvec3 down =
                glm::transpose(glm::dmat3(glm::dmat4(fromPenumbra(light.shape.worldFromLight)))) *
                glm::dvec3(-beside_m, -4, 0);
            const double candela = light.profile->profile->grid.at(profileFromShape(light) * down);
            const double farField = candela * 4 / std::sqrt(distance2) / distance2;
            EXPECT_NEAR(centerLux(light), farField, 0.01 * farField) << int(shape.shape) << " " << beside_m;
        }
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

TEST_F(FrameTest, WhereCandelaFallOffSteeplyMorePointsOfALightAreSummed) {
    constexpr int places = 50, pointsAlong = 150;
    const float seen_m = 4;
    std::mt19937 random(24);
    std::uniform_int_distribution<int> anyPixel(0, pictureWidth_px - 1);
    for (const double fall_deg : {5.0, 2.5})
        for (const double height_m : {0.6, 1.0, 2.0}) {
            Light light = profiledLight({.shape = LightShape::rect, .width_m = 0.6f, .height_m = 0.6f}, true,
                                        height_m, 0);
            LightProfile profile;
            profile.grid = {.verticals_deg = {0, 40, 40 + fall_deg, 90},
                            .horizontals_deg = {0},
                            .candela = {1000, 1000, 0, 0}};
            light.profile->profile = std::make_shared<LightProfile>(profile);
            // Places that get less than a fiftieth of what the one straight below gets may be off by as much
            // as if they got that.
            const double least_lux = 0.02 * summedLux(light, {0, 0, 0}, pointsAlong);
            const Scene scene = withMoment(whiteFloorUnder(light), [seen_m](SceneMoment& moment) {
                moment.cameras.front().orthographicHeight_m = seen_m;
            });
            const glm::dmat4 worldFromCamera(scene.at(0).cameras.front().worldFromCamera);
            const Image radiance = smallPicture(scene);
            for (int i = 0; i < places; ++i) {
                const glm::ivec2 pixel(anyPixel(random), anyPixel(random));
                const glm::dvec2 aside_m =
                    ((glm::dvec2(pixel) + 0.5) / double(pictureWidth_px) - 0.5) * double(seen_m);
                glm::dvec3 place(worldFromCamera * glm::dvec4(aside_m.x, -aside_m.y, 0, 1));  // rows go down
                place.y = 0;
                const double right = summedLux(light, place, pointsAlong);
                EXPECT_NEAR(glm::pi<double>() * double(radiance.at(pixel.x, pixel.y, 1)), right,
                            0.02 * std::max(right, least_lux))
                    << fall_deg << " degrees, from " << height_m << " m at " << place.x << ", " << place.z;
            }
        }
}

TEST_F(FrameTest, UprightTubesAndStandingPanelsShineAboutTheLuminairesAxis) {
    // Put where a luminaire's file has an upright cylinder, a panel that faces C0, and one that faces C90.
    using Shape = LuminousOpening::Shape;
    for (const LuminousOpening& opening :
         {LuminousOpening{Shape::circle, 0.1, 0.1, 0.6}, LuminousOpening{Shape::rectangle, 0, 0.5, 0.3},
          LuminousOpening{Shape::rectangle, 0.5, 0, 0.3}}) {
        const NearestLight nearest = nearestLight(opening, false, true);
        for (const double height_m : {1.5, 2.5})
            for (const double beside_m : {0.7, 1.6}) {
                Light light = profiledLight(nearest.shape, true, height_m, beside_m);
                // Turned, so that neither of what stands is seen edge on.
                const glm::mat4 hung = glm::rotate(worldFromLightOf(light), 0.6f, glm::vec3(0, 0, 1));
                light.profile->luminaireFromShape = nearest.luminaireFromShape;
                place(light, hung);
                const bool isTube = light.shape.shape == LightShape::cylinder;
                const double right = isTube ? summedLuxOfTube(light) : summedLux(light);
                EXPECT_NEAR(centerLux(light), right, 0.02 * right)
                    << opening.name() << " " << height_m << " " << beside_m;
                // What the luminaire sends from its middle, roughly: a turn taken wrongly shows.
                const glm::dvec3 from(beside_m, height_m, 0);
                const glm::dvec3 away = glm::transpose(glm::dmat3(hung)) * -from;
                const glm::dmat3 turn(glm::rotate(glm::dmat4(1), -0.4, glm::dvec3(0, 0, 1)));
                const double candela = light.profile->profile->grid.at(turn * away);
                EXPECT_NEAR(right, candela * height_m / std::pow(glm::length(from), 3), 0.1 * right)
                    << opening.name() << " " << height_m << " " << beside_m;
            }
    }
}

TEST_F(FrameTest, AngleScalesStretchProfilesAboutOneEnd) {
    // UsdLux: above 0 what was sent at gamma is sent at scale * gamma; below 0 the same counted from above.
    constexpr double height_m = 3, beside_m = 2.5;
    Light light = profiledLight({.shape = LightShape::sphere}, false, height_m, beside_m);
    light.emission.unit = Emission::Unit::candela;  // a point
    const glm::dmat3 lightFromWorld =
        glm::transpose(glm::dmat3(glm::dmat4(fromPenumbra(light.shape.worldFromLight))));
    const glm::dvec3 away = profileFromShape(light) * lightFromWorld * glm::dvec3(-beside_m, -height_m, 0);
    const double gamma_deg = glm::degrees(std::atan2(std::hypot(away.x, away.y), -away.z));
    const double c_deg = glm::degrees(std::atan2(away.y, away.x));
    for (const float scale : {0.0f, 0.75f, 1.0f, 1.6f, -0.75f, -0.9f, -1.2f}) {
        light.profile->angleScale = scale;
        const double read_deg = scale > 0   ? gamma_deg / double(scale)
                                : scale < 0 ? 180 - (180 - gamma_deg) / -double(scale)
                                            : gamma_deg;
        const double candela =
            read_deg < 0 ? 0 : light.profile->profile->grid.at(directionOf(read_deg, c_deg));
        const double right = candela * height_m / std::pow(std::hypot(height_m, beside_m), 3);
        EXPECT_NEAR(centerLux(light), right, 1e-3 * right + 1e-6) << scale;
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
