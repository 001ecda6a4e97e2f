// SPDX-License-Identifier: Apache-2.0
// Wedges that survive everything: edges, faces and lights where the published method has no answer.
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "studio/scene/builtin/builtin.h"
#include "studio/scene/builtin/mesh_kit.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

constexpr PictureSize size{160, 120};
const glm::vec3 lightPlace(0, 3.5f, 0);

Mesh triangles(std::vector<glm::vec3> positions, std::vector<std::uint32_t> indices) {
    Mesh mesh;
    mesh.positions = std::move(positions);
    mesh.indices = std::move(indices);
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 1, 0));
    return mesh;
}

Mesh moved(Mesh mesh, const glm::mat4& worldFromMesh) {
    for (glm::vec3& p : mesh.positions) p = glm::vec3(worldFromMesh * glm::vec4(p, 1));
    for (glm::vec3& n : mesh.normals) n = glm::mat3(worldFromMesh) * n;
    return mesh;
}

Mesh moved(Mesh mesh, const glm::vec3& by) {
    return moved(std::move(mesh), glm::translate(glm::mat4(1), by));
}

/// A ground, casters in world space, and a light of 0.8 m at `lightPlace` that shines down.
Scene under(Mesh casters, LightShape shape = LightShape::rect) {
    Scene scene = makeBuiltin("cylinder");
    Mesh& mesh = *std::ranges::find(scene.meshes, "cylinder", &Mesh::name);
    casters.name = mesh.name;
    casters.material = mesh.material;
    mesh = moved(std::move(casters), {0, -1.25f, 0});
    return withLight(std::move(scene), [shape](Light& light) {
        light.shape.shape = shape;
        light.shape.width_m = light.shape.height_m = 0.8f;
        light.shape.radius_m = 0.4f;
        light.shape.worldFromLight = {
            {{{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {lightPlace.x, lightPlace.y, lightPlace.z, 1}}}};
    });
}

class SoftVolumesInputTest : public TechniqueTest {
  protected:
    /// What the issue asks of single blockers; wedges are wrong about many of these, but never out of range.
    static void expectSurvived(const char* name, const Scene& scene, double mostMean = 0.005) {
        SCOPED_TRACE(name);
        const VisibilityMetrics metrics = judge(truth(scene, size), render("soft-volumes", scene, size));
        EXPECT_LE(metrics.mae, mostMean);
        EXPECT_LE(metrics.penumbra_rmse, 0.03);
        EXPECT_LE(metrics.leak, 0.005);
        EXPECT_LE(metrics.false_shadow, 0.005);
        for (const float v : render("soft-volumes", scene, size, {{"method", "wedges"}}).visibility.values)
            ASSERT_TRUE(v >= 0 && v <= 1) << v;
    }
};

TEST_F(SoftVolumesInputTest, EdgesMayPointAtTheLight) {
    const glm::vec3 way = glm::normalize(lightPlace - glm::vec3(0.5f, 1, 0.3f));
    const glm::vec3 side = glm::normalize(glm::cross(way, {0, 0, 1}));
    glm::mat4 aimed(glm::vec4(side, 0), glm::vec4(way, 0), glm::vec4(glm::cross(side, way), 0),
                    glm::vec4(0.5f, 1, 0.3f, 1));
    expectSurvived("a rod along a line through the light's centre",
                   under(moved(cylinder(0.1f, 1.5f, 12), aimed)));
    // To the centre it is a line; both of its classes are as good.
    expectSurvived("a sheet in a plane through the light's centre",
                   under(triangles({{0, 0.8f, -0.6f}, {0, 0.8f, 0.6f}, {0, 2.2f, 0.6f}, {0, 2.2f, -0.6f}},
                                   {0, 1, 2, 0, 2, 3})));
}

TEST_F(SoftVolumesInputTest, CastersMayCrossTheLightsPlane) {
    for (const LightShape shape : {LightShape::rect, LightShape::disk, LightShape::sphere}) {
        expectSurvived("a wall beside the light, from below its plane to above it",
                       under(moved(box({0.1f, 2.5f, 1.5f}), {0.7f, 3, 0.1f}), shape));
        // What cuts through the light is seen at 64 points: where one layer lies behind another there is no
        // exact mean.
        expectSurvived("a plate that hangs on two of the light's sides",
                       under(moved(box({0.5f, 0.05f, 1.5f}), {0.5f, 3.499f, 0}), shape), 1.0 / 64);
    }
}

TEST_F(SoftVolumesInputTest, LightsInsideOfAClosedCasterShineNowhereElse) {
    for (const LightShape shape : {LightShape::rect, LightShape::disk, LightShape::sphere}) {
        const LightResult result =
            render("soft-volumes", under(moved(box({1, 1, 1}), lightPlace), shape), size);
        for (std::size_t i = 0; i < result.visibility.values.size(); ++i) {
            if (result.reach.values[i] > 0) {
                ASSERT_EQ(result.visibility.values[i], 0) << int(shape);
            }
        }
    }
}

TEST_F(SoftVolumesInputTest, EdgesMayHaveAnyNumberOfFaces) {
    const float h = 1.5f;
    expectSurvived("a single triangle",
                   under(triangles({{-0.5f, h, -0.5f}, {0.6f, h, -0.4f}, {0, h + 0.3f, 0.7f}}, {0, 1, 2})));
    expectSurvived(
        "three fins on an edge, one of them twice and the other way round",
        under(
            triangles({{0, h, -0.6f}, {0, h, 0.6f}, {0.7f, h, 0}, {-0.5f, h + 0.4f, 0}, {-0.3f, h - 0.5f, 0}},
                      {0, 1, 2, 0, 1, 3, 0, 1, 4, 1, 0, 4})));
    Mesh moebius = triangles({}, {});
    const std::uint32_t n = 24;
    for (std::uint32_t i = 0; i < n; ++i) {
        const float turn = 2 * 3.14159265f * float(i) / float(n);
        const glm::vec3 out(std::cos(turn), 0, std::sin(turn));
        const glm::vec3 across =
            0.25f * (std::cos(0.5f * turn) * out + glm::vec3(0, std::sin(0.5f * turn), 0));
        for (const float side : {-1.0f, 1.0f})
            moebius.positions.push_back(glm::vec3(0, h, 0) + 0.7f * out + side * across);
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        // Round, it comes back with its sides exchanged.
        const std::uint32_t a = 2 * i, b = a + 1, c = i + 1 < n ? a + 2 : 1, d = i + 1 < n ? a + 3 : 0;
        moebius.indices.insert(moebius.indices.end(), {a, b, c, c, b, d});
    }
    moebius.normals.assign(moebius.positions.size(), glm::vec3(0, 1, 0));
    expectSurvived("a Moebius strip", under(moebius));
}

/// A square with T-junctions along its middle: two triangles on the one side, `parts` fans on the other.
Mesh squareWithJunctions(int parts) {
    Mesh mesh = triangles({{-0.6f, 1.5f, -0.6f}, {-0.6f, 1.5f, 0.6f}, {0, 1.5f, 0.6f}, {0, 1.5f, -0.6f}},
                          {0, 1, 2, 0, 2, 3});
    const auto first = std::uint32_t(mesh.positions.size());
    for (int i = 0; i <= parts; ++i) {
        const float z = -0.6f + 1.2f * float(i) / float(parts);
        mesh.positions.insert(mesh.positions.end(), {{0, 1.5f, z}, {0.6f, 1.5f, z}});
    }
    for (std::uint32_t i = first; i + 3 < mesh.positions.size(); i += 2)
        mesh.indices.insert(mesh.indices.end(), {i, i + 2, i + 1, i + 1, i + 2, i + 3});
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 1, 0));
    return mesh;
}

TEST_F(SoftVolumesInputTest, SurfacesNeedNotBeWeldedNorWellShaped) {
    const Scene whole = under(squareWithJunctions(1));
    const LightResult result = render("soft-volumes", whole, size);
    expectSurvived("a square", whole);
    // Where no line of triangles leaks, the exact mean says the same but for its own steps, millionths each.
    EXPECT_EQ(
        shareOfDifferentPixels(result, render("soft-volumes", under(squareWithJunctions(7)), size), 1e-3f),
        0);
    EXPECT_EQ(
        shareOfDifferentPixels(result, render("soft-volumes", under(squareWithJunctions(300)), size), 1e-3f),
        0);
    // Corners that are an ulp apart.
    Mesh apart = squareWithJunctions(7);
    for (std::size_t i = 4; i < apart.positions.size(); ++i)
        apart.positions[i].y = std::nextafter(apart.positions[i].y, i % 2 == 0 ? 9.0f : 0.0f);
    EXPECT_EQ(shareOfDifferentPixels(result, render("soft-volumes", under(apart), size), 1e-3f), 0);
    // Two millimetres by two metres, a thousandth as wide as far from the ground.
    expectSurvived("wires", under(triangles({{-1, 1.5f, 0},
                                             {1, 1.5f, 0.002f},
                                             {1, 1.5f, 0},
                                             {-1, 1.2f, 0.3f},
                                             {1, 1.2f, 0.302f},
                                             {1, 1.2f, 0.3f}},
                                            {0, 1, 2, 3, 4, 5})));
}

TEST_F(SoftVolumesInputTest, NothingJumpsWhereAnEdgePassesTheLightsCenter) {
    // Seen from the middle of the penumbra the edge of the half-plane goes through the light's centre. A
    // metre of light: V changes by as much as the light moves, in metres.
    constexpr float step_m = 1e-4f;
    const auto movedBy = [](float x_m) {
        return withLight(makeBuiltin("half-plane"),
                         [x_m](Light& light) { light.shape.worldFromLight.columns[3][0] += x_m; });
    };
    const LightResult middle = render("soft-volumes", movedBy(0), size);
    for (const float x_m : {-step_m, step_m}) {
        const LightResult beside = render("soft-volumes", movedBy(x_m), size);
        EXPECT_EQ(shareOfDifferentPixels(middle, beside, 2 * step_m), 0) << x_m;
        EXPECT_GT(shareOfDifferentPixels(middle, beside, 0.5f * step_m), 0.05) << x_m;
    }
}

TEST_F(SoftVolumesInputTest, SliversOfALightOverTheHorizonAreSampledAsWell) {
    // A light that stands on its edge, a sixty-fourth of it above the ground.
    constexpr PictureSize few{96, 72};
    for (const LightShape shape : {LightShape::rect, LightShape::disk}) {
        const Scene scene = withLight(makeBuiltin("cylinder"), [&](Light& light) {
            light.shape.shape = shape;
            light.shape.width_m = light.shape.height_m = 2;
            light.shape.radius_m = 1;
            light.shape.worldFromLight = {
                {{{0, 0, 1, 0}, {0, 1, 0, 0}, {-1, 0, 0, 0}, {-3, -0.96875f, 0.2f, 1}}}};
        });
        // Of 4,096 rays 64 start above the horizon, and 13 for the disk; of 64 points one and none.
        const VisibilityMetrics metrics = judge(truth(scene, few, 4096), render("soft-volumes", scene, few));
        EXPECT_LE(metrics.penumbra_rmse, 0.06) << int(shape);
        EXPECT_LE(metrics.mae, 0.01) << int(shape);
    }
}

TEST_F(SoftVolumesInputTest, AlphaMasksOfWedgesBlockAsAWholeAndTheLogSaysSo) {
    const Scene solid = makeBuiltin("two-boxes");
    Scene masked = solid;
    masked.pictures.push_back({.name = "holes", .width_px = 1, .height_px = 1, .rgba = {255, 255, 255, 0}});
    masked.textures.push_back({.picture = int(masked.pictures.size()) - 1});
    const int upper = std::ranges::find(masked.meshes, "box 1", &Mesh::name)->material;
    masked.materials[std::size_t(upper)].alpha = Material::Alpha::mask;
    masked.materials[std::size_t(upper)].baseColorTexture = int(masked.textures.size()) - 1;
    testing::internal::CaptureStdout();
    const LightResult result = render("soft-volumes", masked, size, {{"method", "wedges"}});
    EXPECT_NE(testing::internal::GetCapturedStdout().find("as if their masks had no holes"),
              std::string::npos);
    // What is not drawn of the masked box shows the ground, in the box's shadow.
    EXPECT_GT(shareOfDifferentPixels(result, truth(masked, size, 16), 0.5f), 0.02);
    testing::internal::CaptureStdout();
    render("soft-volumes", solid, size, {{"method", "wedges"}});
    EXPECT_EQ(testing::internal::GetCapturedStdout().find("masks"), std::string::npos);
}

TEST_F(SoftVolumesInputTest, LayersSeeTheHolesOfAlphaMasks) {
    Picture holes{.name = "holes", .width_px = 8, .height_px = 8, .rgba = {}};
    for (int i = 0; i < 64; ++i)
        holes.rgba.insert(holes.rgba.end(), {255, 255, 255, std::uint8_t((i + i / 8) % 2 == 0 ? 255 : 0)});
    Scene scene = withAlphaMask(makeBuiltin("two-boxes"), std::move(holes));
    for (Mesh& mesh : scene.meshes) {
        mesh.uvs.clear();
        for (const glm::vec3& p : mesh.positions) mesh.uvs.emplace_back(p.x / 2, p.z / 2);
    }
    const LightResult exact = truth(scene, size);
    const VisibilityMetrics metrics = judge(exact, render("soft-volumes", scene, size));
    EXPECT_GT(judge(exact, render("soft-volumes", scene, size, {{"method", "wedges"}})).penumbra_rmse, 0.2);
    EXPECT_LE(metrics.penumbra_rmse, 0.06);
    // More points see more.
    EXPECT_LT(judge(exact, render("soft-volumes", scene, size, {{"samples", "256"}})).penumbra_rmse,
              metrics.penumbra_rmse);
}

}  // namespace
}  // namespace penumbra::studio
