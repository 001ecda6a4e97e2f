// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/builtin/builtin.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

using HardShadowMapTest = TechniqueTest;

constexpr PictureSize size{400, 300};

TEST_F(HardShadowMapTest, EqualsTheReferenceForALightOfSizeZero) {
    for (const char* name : {"primitives", "torus", "sphere", "two-boxes", "overlapping-blockers", "cylinder",
                             "columns", "moving"}) {
        const Scene scene = withLight(makeBuiltin(name), shrinkToPoint);
        EXPECT_LE(shareOfDifferentPixels(truth(scene, size), render("hard", scene, size), 0.5f), 0.01)
            << name;
    }
}

TEST_F(HardShadowMapTest, EqualsTheReferenceForEveryShapeOfLight) {
    for (const LightShape shape : {LightShape::disk, LightShape::sphere, LightShape::distant}) {
        const Scene scene = withLight(makeBuiltin("primitives"), [&](Light& light) {
            light.shape.shape = shape;
            shrinkToPoint(light);
        });
        EXPECT_LE(shareOfDifferentPixels(truth(scene, size), render("hard", scene, size), 0.5f), 0.01)
            << int(shape);
    }
}

TEST_F(HardShadowMapTest, WhatLiesBehindASurfaceEdgeOnToTheLightDoesNotShadowIt) {
    // The front of the upper box, z = 0.55, is a hundredth of a texel wide. Its plane, continued to the
    // middle of the texel, lies behind the boxes. The front is 0.3 % of what is lit; borders of shadows err
    // by 0.07 %.
    const Scene scene = withLight(makeBuiltin("two-boxes"), [](Light& light) {
        shrinkToPoint(light);
        light.shape.worldFromLight.columns[3][2] = 0.551f;
    });
    const LightResult result = render("hard", scene, size, {{"map_size", "512"}});
    EXPECT_LE(judge(truth(scene, size), result).false_shadow, 0.0014);
}

/// A light among the casters needs a cube of maps, whose faces must meet without a seam.
TEST_F(HardShadowMapTest, CubeOfMapsHasNoSeams) {
    const Scene scene = withMoment(makeBuiltin("columns"), [](SceneMoment& moment) {
        moment.lights.resize(1);
        shrinkToPoint(moment.lights.front());
        for (Instance& instance : moment.instances) instance.casts = false;
    });
    const std::unique_ptr<Technique> hard = workbench().makeTechnique("hard");
    const LightResult result = render(*hard, scene, size);
    EXPECT_GT(result.statistics.counts.front().value, 1) << "maps";
    EXPECT_EQ(shareOfDifferentPixels(truth(scene, size), result, 0), 0);
}

TEST_F(HardShadowMapTest, FinerMapsAreNearerToTheTruth) {
    const Scene scene = withLight(makeBuiltin("primitives"), shrinkToPoint);
    const LightResult exact = truth(scene, size);
    const auto error = [&](const char* mapSize) {
        return shareOfDifferentPixels(exact, render("hard", scene, size, {{"map_size", mapSize}}), 0.5f);
    };
    EXPECT_LT(error("2048"), 0.5 * error("256"));
}

TEST_F(HardShadowMapTest, HolesOfAlphaMasksLetLightThrough) {
    // Half of the window's blockers' material is cut away by its texture's alpha, on either side of a
    // straight line.
    Scene scene = withLight(makeBuiltin("two-boxes"), shrinkToPoint);
    Picture stripes{
        .name = "stripes", .width_px = 2, .height_px = 1, .rgba = {255, 255, 255, 255, 255, 255, 255, 0}};
    for (Mesh& mesh : scene.meshes) {
        mesh.uvs.clear();
        for (const glm::vec3& p : mesh.positions) mesh.uvs.emplace_back(p.x * 2, 0.5f);
    }
    scene = withAlphaMask(std::move(scene), stripes);
    const LightResult exact = truth(scene, size);
    EXPECT_LE(shareOfDifferentPixels(exact, render("hard", scene, size), 0.5f), 0.02);
    // And the holes matter.
    const LightResult solid = truth(withLight(makeBuiltin("two-boxes"), shrinkToPoint), size);
    EXPECT_GE(shareOfDifferentPixels(exact, solid, 0.5f), 0.02);
}

TEST_F(HardShadowMapTest, TooLargeMapsAreRefused) {
    const std::unique_ptr<Technique> hard = workbench().makeTechnique("hard");
    EXPECT_THROW(setParameter(*hard, "map_size", "0"), Error);
    EXPECT_THROW(setParameter(*hard, "map_size", "32768"), Error);
}

}  // namespace
}  // namespace penumbra::studio
