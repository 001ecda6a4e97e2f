// SPDX-License-Identifier: Apache-2.0
// Lights that are seen themselves, against known answers.
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>
#include <vector>

#include "studio/scene/builtin/mesh_kit.h"
#include "studio/scene/builtin/placing.h"
#include "studio/scene/builtin/scene_builder.h"
#include "studio/scene/profiles/light_profile.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

constexpr PictureSize pictureSize{65, 65};
constexpr glm::vec3 seen_nits(3000, 2000, 1000);

class LuminairesTest : public TechniqueTest {
  protected:
    void TearDown() override {
        workbench().frame().showLuminaires(false);
        TechniqueTest::TearDown();
    }

    static TechniqueResult picture(const Scene& scene, bool areShown = true) {
        const auto hard = workbench().makeTechnique("hard");
        const SceneMoment moment = scene.at(0);
        workbench().open(scene);
        workbench().frame().showLuminaires(areShown);
        return workbench().run("hard", *hard, moment, moment.cameras.front(), pictureSize);
    }
    static glm::vec3 pixel(const Image& radiance, int x, int y) {
        return {radiance.at(x, y, 0), radiance.at(x, y, 1), radiance.at(x, y, 2)};
    }
    static glm::vec3 middle_nits(const Scene& scene) {
        return pixel(picture(scene).radiance, pictureSize.width_px / 2, pictureSize.height_px / 2);
    }
};

/// A light of any shape, 4 m over the origin, that shines straight down.
Light overhead(const AreaLight& shape) {
    Light light = rectLight("light", 1, 1, {0, 4, 0}, {0, 0, 0}, 1);
    const Mat4 place = light.shape.worldFromLight;
    light.shape = shape;
    light.shape.worldFromLight = place;
    light.emission = {Emission::Unit::nits, seen_nits};
    return light;
}

const AreaLight rect{.shape = LightShape::rect, .width_m = 1, .height_m = 0.5f};
const AreaLight disk{.shape = LightShape::disk, .radius_m = 0.5f};
const AreaLight ball{.shape = LightShape::sphere, .radius_m = 0.5f};
const AreaLight tube{.shape = LightShape::cylinder, .length_m = 1, .radius_m = 0.25f};

/// A floor, these lights, and a camera that looks from one place at another.
SceneBuilder roomWith(const std::vector<Light>& lights, const glm::vec3& eye, const glm::vec3& target) {
    SceneBuilder scene("luminaires");
    scene.ground(20);
    for (const Light& light : lights) scene.light(light);
    scene.camera(camera("eye", eye, target));
    return scene;
}

Scene fromBelow(const Light& light) {
    return roomWith({light}, {0, 1, 0}, {0, 4, 0}).build();
}

TEST_F(LuminairesTest, EveryShapeShowsItsLuminance) {
    for (const AreaLight& shape : {rect, disk, ball, tube})
        EXPECT_EQ(middle_nits(fromBelow(overhead(shape))), seen_nits) << int(shape.shape);
}

TEST_F(LuminairesTest, AsLargeAsItLooks) {
    // Of a picture that is 2 tan(0.35) times as wide as it is far away.
    const auto share = [](const AreaLight& shape) {
        const Image radiance = picture(fromBelow(overhead(shape))).radiance;
        double count = 0;
        for (int y = 0; y < radiance.height_px; ++y)
            for (int x = 0; x < radiance.width_px; ++x) count += pixel(radiance, x, y) == seen_nits;
        return count / double(radiance.pixelCount());
    };
    const double side = 2 * std::tan(0.35), pixels = 3.0 / pictureSize.width_px;
    const auto expect = [&](const AreaLight& shape, double width, double height) {
        const double right = width * height / (side * side);
        EXPECT_NEAR(share(shape), right, pixels * right) << int(shape.shape);
    };
    const double round = std::sqrt(glm::pi<double>());
    expect(rect, 1 / 3.0, 0.5 / 3);
    expect(disk, round * 0.5 / 3, round * 0.5 / 3);
    expect(ball, round * std::tan(std::asin(0.5 / 3)), round * std::tan(std::asin(0.5 / 3)));
    // Line by line from one of its outer ones to the other: the nearer a line, the longer it looks.
    constexpr int lines = 1000;
    const double outer = std::tan(std::asin(0.25 / 3)), step = 2 * outer / lines;
    double lengths = 0;
    for (int i = 0; i < lines; ++i) {
        const double slope = (i + 0.5) * step - outer, length2 = 1 + slope * slope;
        lengths += length2 / (3 - std::sqrt(9 - length2 * (9 - 0.0625)));
    }
    expect(tube, lengths / lines, 2 * outer);
}

TEST_F(LuminairesTest, FlatOnesAreSeenFromTheSideToWhichTheyShine) {
    for (const AreaLight& shape : {rect, disk}) {
        Light light = overhead(shape);
        const auto fromAbove = [&] { return middle_nits(roomWith({light}, {0, 7, 0}, {0, 0, 0}).build()); };
        EXPECT_LT(fromAbove().x, 1000) << "the floor behind it";
        light.shape.twoSided = true;
        EXPECT_EQ(fromAbove(), seen_nits);
    }
    EXPECT_EQ(middle_nits(roomWith({overhead(ball)}, {0, 4.1f, 0}, {0, 9, 0}).build()), glm::vec3(0))
        << "dark from within";
    EXPECT_EQ(middle_nits(roomWith({overhead(tube)}, {3, 4, 0}, {0, 4, 0}).build()), glm::vec3(0))
        << "its ends are dark";
}

TEST_F(LuminairesTest, WhatStandsBeforeItHidesItAndWhatLiesInItsPlaneDoesNot) {
    const auto withCeiling = [](float height_m) {
        SceneBuilder scene = roomWith({overhead(rect)}, {0, 1, 0}, {0, 4, 0});
        scene.place("ceiling", scene.mesh("ceiling", plane(10, 10), glm::vec3(0.5f)), at({0, height_m, 0}));
        return middle_nits(std::move(scene).build());
    };
    EXPECT_EQ(withCeiling(4), seen_nits) << "flush";
    EXPECT_EQ(withCeiling(4.001f), seen_nits);
    EXPECT_LT(withCeiling(3.999f).x, 1000);
}

TEST_F(LuminairesTest, TheNearestIsSeen) {
    Light far = overhead(rect), near = overhead(ball);
    near.name = "near";
    near.shape.worldFromLight.columns[3][1] = 3;
    near.emission.value = {1, 2, 3};
    for (const std::vector<Light>& lights : {std::vector{far, near}, std::vector{near, far}})
        EXPECT_EQ(middle_nits(roomWith(lights, {0, 1, 0}, {0, 4, 0}).build()), near.emission.value);
}

TEST_F(LuminairesTest, ConesAndProfilesShapeWhatIsSeen) {
    const glm::vec3 aside(4 * std::tan(0.5f), 0, 0);  // half a radian off its axis
    Light spot = overhead(disk);
    spot.cone_rad = {0.3f, 0.4f};
    EXPECT_EQ(middle_nits(roomWith({spot}, aside, {0, 4, 0}).build()), glm::vec3(0));
    EXPECT_EQ(middle_nits(fromBelow(spot)), seen_nits);

    // 600 cd straight down, 300 to the side.
    LightProfile profile;
    profile.grid.verticals_deg = {0, 90};
    profile.grid.horizontals_deg = {0};
    profile.grid.candela = {600, 300};
    for (const bool isLuminaire : {true, false})
        for (const auto& [shape, area_m2] :
             {std::pair(rect, 0.5 * std::cos(0.5)), std::pair(disk, glm::pi<double>() * 0.25 * std::cos(0.5)),
              std::pair(ball, glm::pi<double>() * 0.25), std::pair(tube, 0.5 * std::cos(0.5))}) {
            Light lamp = overhead(shape);
            lamp.emission = {isLuminaire ? Emission::Unit::candela : Emission::Unit::nits, glm::vec3(1)};
            lamp.profile = {.profile = std::make_shared<LightProfile>(profile), .isLuminaire = isLuminaire};
            const double candela = 600 - 300 * 0.5 / glm::half_pi<double>();
            const double right = isLuminaire ? candela / area_m2 : candela;
            // A tube lies along the picture's X and shows less of its length from there; the others turn
            // away.
            EXPECT_NEAR(middle_nits(roomWith({lamp}, aside, {0, 4, 0}).build()).x, right, 0.002 * right)
                << int(shape.shape) << isLuminaire;
        }
}

TEST_F(LuminairesTest, ItBlocksNothingAndIsNoSurface) {
    const Scene scene = roomWith({overhead(ball)}, {0, 2, 9}, {0, 3, 0}).build();
    const TechniqueResult with = picture(scene), without = picture(scene, false);
    EXPECT_EQ(with.lights[0].visibility.values, without.lights[0].visibility.values);
    EXPECT_EQ(with.lights[0].reach.values, without.lights[0].reach.values);
    EXPECT_EQ(with.exposureValue, without.exposureValue);
    int differ = 0;
    for (int y = 0; y < pictureSize.height_px; ++y)
        for (int x = 0; x < pictureSize.width_px; ++x) {
            if (pixel(with.radiance, x, y) == pixel(without.radiance, x, y)) continue;
            EXPECT_EQ(pixel(with.radiance, x, y), seen_nits);
            EXPECT_GT(pixel(with.display, x, y).x, pixel(without.display, x, y).x) << "also before the sky";
            ++differ;
        }
    EXPECT_GT(differ, 20);
}

TEST_F(LuminairesTest, SizelessAndDistantOnesAreNotSeen) {
    const AreaLight point{.shape = LightShape::sphere}, sun{.shape = LightShape::distant, .angle_rad = 0.1f};
    for (const AreaLight& shape : {point, sun}) {
        const Scene scene = fromBelow(overhead(shape));
        EXPECT_EQ(picture(scene).radiance.values, picture(scene, false).radiance.values);
    }
}

TEST_F(LuminairesTest, OrthographicCamerasSeeThemToo) {
    SceneBuilder builder = roomWith({overhead(rect)}, {0, 1, 0}, {0, 4, 0});
    const Scene scene = withMoment(std::move(builder).build(), [](SceneMoment& moment) {
        moment.cameras.front().orthographicHeight_m = 2;
    });
    const Image radiance = picture(scene).radiance;
    EXPECT_EQ(pixel(radiance, 32, 32), seen_nits);
    EXPECT_EQ(pixel(radiance, 17, 32), seen_nits) << "0.46 m from the middle";
    EXPECT_EQ(pixel(radiance, 15, 32), glm::vec3(0)) << "0.52 m from the middle";
}

}  // namespace
}  // namespace penumbra::studio
