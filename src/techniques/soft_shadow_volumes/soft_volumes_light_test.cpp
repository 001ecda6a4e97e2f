// SPDX-License-Identifier: Apache-2.0
// How near counted layers come to the truth, whatever the light.
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

#include "studio/scene/builtin/builtin.h"
#include "studio/scene/builtin/mesh_kit.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

using SoftVolumesLightTest = TechniqueTest;

constexpr PictureSize size{240, 180}, small{160, 120};

TEST_F(SoftVolumesLightTest, SingleBlockersAreAsGoodAsTheReferenceCanTell) {
    for (const char* name : {"sphere", "two-boxes", "disk-over-ground", "torus"}) {
        const Scene scene = makeBuiltin(name);
        const VisibilityMetrics metrics = judge(truth(scene, size), render("soft-volumes", scene, size));
        EXPECT_LE(metrics.mae, 0.005) << name;
        EXPECT_LE(metrics.penumbra_rmse, 0.03) << name;
    }
}

// Up to half as wide as it is far, where silhouettes from its centre are far from the truth.
TEST_F(SoftVolumesLightTest, NoSizeOfALightIsHarderThanAnother) {
    for (const LightShape shape :
         {LightShape::rect, LightShape::disk, LightShape::sphere, LightShape::distant}) {
        for (const float share : {0.02f, 0.1f, 0.25f, 0.5f}) {
            const Scene scene = withLight(makeBuiltin("sphere"), [&](Light& light) {
                const auto& place = light.shape.worldFromLight.columns[3];
                const float width_m =
                    share * glm::distance(glm::vec3(place[0], place[1], place[2]), glm::vec3(0, 1.5f, 0));
                light.shape.shape = shape;
                light.shape.width_m = light.shape.height_m = width_m;
                light.shape.radius_m = 0.5f * width_m;
                light.shape.angle_rad = 2 * std::atan(0.5f * share);
            });
            const VisibilityMetrics metrics =
                judge(truth(scene, small), render("soft-volumes", scene, small));
            EXPECT_LE(metrics.mae, 0.005) << int(shape) << " " << share;
            EXPECT_LE(metrics.penumbra_rmse, 0.03) << int(shape) << " " << share;
        }
    }
}

/// The scene of the cylinder with a figure in its place: limbs that run into each other, before each other as
/// seen from the light and from the ground.
Scene figure() {
    Scene scene = makeBuiltin("cylinder");
    Mesh& body = *std::ranges::find(scene.meshes, "cylinder", &Mesh::name);
    body = {.name = body.name, .material = body.material};
    const auto add = [&](const Mesh& part, const glm::mat4& bodyFromPart) {
        for (const std::uint32_t index : part.indices)
            body.indices.push_back(index + std::uint32_t(body.positions.size()));
        for (const glm::vec3& p : part.positions) body.positions.emplace_back(bodyFromPart * glm::vec4(p, 1));
        for (const glm::vec3& n : part.normals) body.normals.push_back(glm::mat3(bodyFromPart) * n);
    };
    const auto limb = [&](float radius_m, const glm::vec3& from, const glm::vec3& to) {
        const glm::vec3 along = glm::normalize(to - from),
                        side = glm::normalize(glm::cross(along, {0.1f, 0.2f, 1}));
        glm::mat4 bodyFromPart(glm::vec4(side, 0), glm::vec4(along, 0), glm::vec4(glm::cross(side, along), 0),
                               glm::vec4(0.5f * (from + to), 1));
        add(studio::cylinder(radius_m, glm::distance(from, to), 24), bodyFromPart);
        bodyFromPart[3] = glm::vec4(to, 1);
        add(studio::sphere(radius_m, 24, 12), bodyFromPart);
    };
    // The mesh stands 1.25 m over the ground.
    limb(0.16f, {0, -0.4f, 0}, {0, 0.2f, 0});
    add(studio::sphere(0.13f, 24, 12), glm::translate(glm::mat4(1), {0, 0.55f, 0}));
    for (const float side : {-1.0f, 1.0f}) {
        limb(0.055f, {0.18f * side, 0.25f, 0}, {0.35f * side, -0.1f, 0.1f});
        limb(0.05f, {0.35f * side, -0.1f, 0.1f}, {0.2f * side, -0.2f, 0.35f});
        limb(0.08f, {0.09f * side, -0.45f, 0}, {0.12f * side, -1.2f, 0.1f * side});
    }
    return scene;
}

TEST_F(SoftVolumesLightTest, ManyPartsThatOverlapAreNearTheReference) {
    // The mean error that is asked of overlapping blockers and of characters.
    for (const Scene& scene : {makeBuiltin("overlapping-blockers"), makeBuiltin("primitives"), figure()}) {
        const VisibilityMetrics metrics = judge(truth(scene, size), render("soft-volumes", scene, size));
        EXPECT_LE(metrics.mae, 0.01) << scene.name;
        EXPECT_LE(metrics.penumbra_rmse, 0.03) << scene.name;
    }
}

// Half of the light is in the box: faces cross its plane, and what they hide ends where they cut it.
TEST_F(SoftVolumesLightTest, FacesThroughTheLightAreNearTheReference) {
    for (const LightShape shape : {LightShape::rect, LightShape::disk}) {
        for (const bool twoSided : {false, true}) {
            const Scene scene = withLight(makeBuiltin("two-boxes"), [&](Light& light) {
                auto& place = light.shape.worldFromLight.columns[3];
                place = {0.35f + 0.9f, 0.8f, 0.1f, 1};
                light.shape.shape = shape;
                light.shape.width_m = light.shape.height_m = 0.8f;
                light.shape.radius_m = 0.4f;
                light.shape.twoSided = twoSided;
            });
            const VisibilityMetrics metrics = judge(truth(scene, size), render("soft-volumes", scene, size));
            // 64 points and 256 rays, and no exact mean where blockers are of different depth.
            EXPECT_LE(metrics.rmse, 0.03) << int(shape) << twoSided;
            EXPECT_LE(metrics.mae, 0.01) << int(shape) << twoSided;
        }
    }
}

Mesh raised(Mesh mesh, float by_m) {
    for (glm::vec3& p : mesh.positions) p.y += by_m;
    return mesh;
}

/// The cylinder's scene with a sphere for a light and this in place of the cylinder, whose middle is at
/// (0, 1.25, 0).
Scene bulbAt(const glm::vec3& place, float radius_m, const Mesh& caster) {
    Scene scene = makeBuiltin("cylinder");
    Mesh& mesh = *std::ranges::find(scene.meshes, "cylinder", &Mesh::name);
    const Mesh old = std::exchange(mesh, caster);
    mesh.name = old.name;
    mesh.material = old.material;
    return withLight(std::move(scene), [place, radius_m](Light& light) {
        light.shape.shape = LightShape::sphere;
        light.shape.radius_m = radius_m;
        light.shape.worldFromLight.columns[3] = {place.x, place.y, place.z, 1};
    });
}

// Where a caster goes into a bulb it ends, in a curve that is no edge.
TEST_F(SoftVolumesLightTest, CastersThatReachIntoABulbAreNearTheReference) {
    struct Case {
        const char* name;
        Scene scene;
    };
    const Case cases[] = {
        {"half in a box", bulbAt({0.5f, 1.25f, 0.1f}, 0.4f, box({1, 1, 1}))},
        {"in the corner of a box", bulbAt({0.5f, 1.75f, 0.5f}, 0.4f, box({1, 1, 1}))},
        {"a rod through it", bulbAt({0.05f, 1.3f, 0.02f}, 0.5f, studio::cylinder(0.12f, 2.4f, 24))},
        {"a shade around it, which it is too wide for",
         bulbAt({0, 1.1f, 0}, 0.45f, studio::cylinder(0.4f, 0.6f, 48, Ends::open))},
        {"a disk through its middle", bulbAt({0, 1.25f, 0}, 0.4f, studio::disk(0.7f, 32))},
        // From below, the shade begins behind what is seen of the bulb.
        {"a shade close around it",
         bulbAt({0, 0.55f, 0}, 0.395f, raised(studio::cylinder(0.4f, 0.6f, 96, Ends::open), -0.65f))},
    };
    for (const auto& [name, scene] : cases) {
        const VisibilityMetrics metrics = judge(truth(scene, small), render("soft-volumes", scene, small));
        // What reaches into the light is seen at 64 points and no better.
        EXPECT_LE(metrics.mae, 1.0 / 64) << name;
        EXPECT_LE(metrics.penumbra_rmse, 0.03) << name;
        EXPECT_LE(metrics.leak, 0.01) << name;
        EXPECT_LE(metrics.false_shadow, 0.01) << name;
    }
}

// The red half of the light is hidden first, then the green one: a half-plane has one silhouette from
// anywhere on the light, so that published wedges are right about it, too.
TEST_F(SoftVolumesLightTest, WedgesOfTexturedLightsAreTheLayersWhereBothAreRight) {
    Scene scene = makeBuiltin("half-plane");
    Picture halves{.name = "halves", .width_px = 32, .height_px = 1, .rgba = {}};
    for (int x = 0; x < halves.width_px; ++x) {
        const bool left = x < halves.width_px / 2;
        halves.rgba.insert(halves.rgba.end(),
                           {std::uint8_t(left ? 255 : 0), std::uint8_t(left ? 0 : 255), 99, 255});
    }
    scene.pictures.push_back(std::move(halves));
    scene.textures.push_back({.picture = int(scene.pictures.size()) - 1});
    const int texture = int(scene.textures.size()) - 1;
    scene = withLight(std::move(scene), [texture](Light& light) { light.texture = texture; });
    const LightResult layers = render("soft-volumes", scene, small);
    const LightResult wedges = render("soft-volumes", scene, small, {{"method", "wedges"}});
    ASSERT_EQ(wedges.visibility.channels, 3);
    int differentChannels = 0;
    for (std::size_t i = 0; i < wedges.visibility.values.size(); i += 3) {
        const float* of = &wedges.visibility.values[i];
        // Their points differ in number: two of 128, and of the 64 that a channel has there.
        for (std::size_t c = 0; c < 3; ++c)
            ASSERT_NEAR(of[c], layers.visibility.values[i + c], 2.0 / 64) << i;
        differentChannels += std::abs(of[0] - of[1]) > 0.5f;
    }
    EXPECT_GT(differentChannels, 500);
    EXPECT_LE(judge(truth(scene, small), wedges).penumbra_rmse, 0.03);
}

TEST_F(SoftVolumesLightTest, TexturedLightsHaveThreeVisibilities) {
    const Scene scene = makeBuiltin("textured-window");
    const LightResult result = render("soft-volumes", scene, size);
    ASSERT_EQ(result.visibility.channels, 3);
    const VisibilityMetrics metrics = judge(truth(scene, size), result);
    EXPECT_LE(metrics.mae, 0.005);
    // The truth's own noise in a penumbra is 0.01 here.
    EXPECT_LE(metrics.penumbra_rmse, 0.02);
}

}  // namespace
}  // namespace penumbra::studio
