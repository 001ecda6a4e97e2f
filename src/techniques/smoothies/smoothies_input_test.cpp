// SPDX-License-Identifier: Apache-2.0
// Blockers and lights that are not as the paper assumes (closed, away from the light, in front of it).
#include <algorithm>

#include "studio/scene/builtin/builtin.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

struct Triangles {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
};

class SmoothiesInputTest : public TechniqueTest {
  protected:
    /// The half-plane scene seen straight down, with other blockers than its sheet, in world space. The light
    /// is 1 m square at (0, 4, 0); the ground shows where |x| < 2 m and |z| < 1.5 m.
    static Scene blockedBy(const Triangles& blocker) {
        Scene scene = makeBuiltin("half-plane");
        const auto sheet = std::ranges::find(scene.meshes, "half-plane", &Mesh::name);
        sheet->positions = blocker.positions;
        sheet->normals.assign(blocker.positions.size(), {0, 1, 0});
        sheet->uvs.clear();
        sheet->indices = blocker.indices;
        const int mesh = int(sheet - scene.meshes.begin());
        return withMoment(std::move(scene), [mesh](SceneMoment& moment) {
            std::ranges::find(moment.instances, mesh, &Instance::mesh)->worldFromMesh = glm::mat4(1);
            moment.cameras.erase(moment.cameras.begin());
        });
    }

    static void expectNearTheTruth(const Triangles& blocker, double penumbraRmse) {
        const Scene scene = blockedBy(blocker);
        const VisibilityMetrics metrics = judge(truth(scene), render("smoothies", scene));
        EXPECT_EQ(metrics.notFinite, 0u);
        EXPECT_LE(metrics.penumbra_rmse, penumbraRmse);
        EXPECT_LE(metrics.leak, 0.005);
        EXPECT_LE(metrics.false_shadow, 0.005);
    }
};

Triangles sheet(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
    return {{a, b, c, d}, {0, 1, 2, 0, 2, 3}};
}

/// A sheet 2 m above the ground whose border is the line x = 0.
const Triangles level = sheet({-3, 2, -6}, {-3, 2, 6}, {0, 2, 6}, {0, 2, -6});

// Half of what the technique promises for curved blockers: edges are straight here.
constexpr double straightEdges = 0.03;

/// The border runs past the light's plane, beside the light, which puts one end infinitely far away in the
/// window.
TEST_F(SmoothiesInputTest, EdgesMayReachBehindTheLight) {
    expectNearTheTruth(sheet({-3, 2, -6}, {-3, 2, 6}, {0, 2, 6}, {0, 2, -6}), straightEdges);
    expectNearTheTruth(sheet({-3, 1, -9}, {-3, 9, 9}, {-0.3f, 9, 9}, {-0.3f, 1, -9}), straightEdges);
    // A wall beside the light, from below its plane to above.
    expectNearTheTruth(sheet({-0.9f, 1.6f, -6}, {-0.9f, 1.6f, 6}, {-0.9f, 9, 6}, {-0.9f, 9, -6}),
                       straightEdges);
}

TEST_F(SmoothiesInputTest, BlockersBehindTheLightDoNothing) {
    const LightResult result =
        render("smoothies", blockedBy(sheet({-3, 5, -6}, {-3, 5, 6}, {0, 5, 6}, {0, 5, -6})));
    EXPECT_TRUE(std::ranges::all_of(result.visibility.values, [](float v) { return v == 1; }));
}

/// The centre of the light lies on the line of the edge, and in the plane of every triangle that has it.
TEST_F(SmoothiesInputTest, EdgesMayPointAtTheLight) {
    Triangles withFin = level;
    withFin.positions.insert(withFin.positions.end(), {{0, 1.6f, 0}, {0, 3, 0}, {0.4f, 1.6f, 0.2f}});
    withFin.indices.insert(withFin.indices.end(), {4, 5, 6});
    const LightResult plain = render("smoothies", blockedBy(level));
    const LightResult result = render("smoothies", blockedBy(withFin));
    // To the centre the fin is a line; what it adds or takes away stays in its penumbra, at most 1.2 m wide.
    for (int y = 0; y < defaultSize.height_px; ++y) {
        for (int x = 0; x < defaultSize.width_px; ++x) {
            const float v = result.visibility.at(x, y);
            ASSERT_TRUE(v >= 0 && v <= 1) << x << ", " << y;
            const double posX = ((x + 0.5) / defaultSize.width_px - 0.5) * 4.0;
            const double posZ = ((y + 0.5) / defaultSize.height_px - 0.5) * 3.0;
            if (std::abs(posX) > 1.4 || std::abs(posZ) > 1.4) {
                ASSERT_NEAR(v, plain.visibility.at(x, y), 0.05) << posX << ", " << posZ;
            }
        }
    }
}

TEST_F(SmoothiesInputTest, LightInsideAClosedBlockerShinesNowhereElse) {
    const float l = -0.7f, h = 0.7f;
    Triangles box{{{l, l, l}, {h, l, l}, {l, h, l}, {h, h, l}, {l, l, h}, {h, l, h}, {l, h, h}, {h, h, h}},
                  {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                   2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5}};
    for (glm::vec3& p : box.positions) p.y += 4;
    const LightResult result = render("smoothies", blockedBy(box));
    EXPECT_EQ(std::ranges::max(result.visibility.values), 0);
}

/// A single triangle, the same twice, a third face on an edge, corners that are not shared: all cast the
/// shadow that they cast.
TEST_F(SmoothiesInputTest, BrokenTopologyCastsItsShadow) {
    Triangles single{{{-3, 2, -6}, {0, 2, 6}, {0, 2, -6}}, {0, 1, 2}};
    expectNearTheTruth(single, straightEdges);

    Triangles twice = level;
    twice.indices.insert(twice.indices.end(), {0, 1, 2, 0, 2, 3});
    expectNearTheTruth(twice, straightEdges);

    Triangles threeFaces = level;  // a strip stands on the border
    threeFaces.positions.insert(threeFaces.positions.end(), {{0, 2.3f, 6}, {0, 2.3f, -6}});
    threeFaces.indices.insert(threeFaces.indices.end(), {3, 2, 4, 3, 4, 5});
    expectNearTheTruth(threeFaces, 2 * straightEdges);  // two edges open on the light, one above the other

    const Triangles& shared = level;
    Triangles apart;
    for (const std::uint32_t index : shared.indices) {
        apart.indices.push_back(std::uint32_t(apart.positions.size()));
        apart.positions.push_back(shared.positions[index]);
    }
    EXPECT_EQ(render("smoothies", blockedBy(shared)).visibility.values,
              render("smoothies", blockedBy(apart)).visibility.values);
}

/// Twice the same with triangles of no area among them, and wound at random.
TEST_F(SmoothiesInputTest, OrderAndWindingOfTrianglesDoNotMatter) {
    Triangles wound = level;
    std::swap(wound.indices[0], wound.indices[1]);
    wound.indices.insert(wound.indices.end(), {1, 1, 2, 0, 2, 0});
    EXPECT_LE(shareOfDifferentPixels(render("smoothies", blockedBy(level)),
                                     render("smoothies", blockedBy(wound)), 0.01f),
              0.0);
}

/// A light whose quarters differ in colour: each channel has its own penumbra.
TEST_F(SmoothiesInputTest, TexturedLightsAreNearTheTruthInEachChannel) {
    constexpr int width_px = 32;  // where quarters meet, filtering mixes a texel
    Picture quarters{.name = "quarters", .width_px = width_px, .height_px = width_px, .rgba = {}};
    for (int i = 0; i < width_px * width_px; ++i) {
        const bool right = i % width_px >= width_px / 2, lower = i / width_px >= width_px / 2;
        const auto value = [](bool on) { return std::uint8_t(on ? 255 : 0); };
        quarters.rgba.insert(quarters.rgba.end(), {value(!right), value(right && !lower), value(lower), 255});
    }
    for (const bool turned : {false, true}) {
        Scene scene = blockedBy(turned ? sheet({-6, 2, -3}, {6, 2, -3}, {6, 2, 0.1f}, {-6, 2, 0.1f}) : level);
        scene.pictures.push_back(quarters);
        scene.textures.push_back({.picture = int(scene.pictures.size()) - 1});
        const int texture = int(scene.textures.size()) - 1;
        scene = withLight(std::move(scene), [=](Light& light) { light.texture = texture; });
        const LightResult result = render("smoothies", scene);
        ASSERT_EQ(result.visibility.channels, 3);
        EXPECT_LE(judge(truth(scene), result).penumbra_rmse, straightEdges);
    }
}

/// Stripes of holes: what they cast is all penumbra.
TEST_F(SmoothiesInputTest, HolesOfAlphaMasksHavePenumbrae) {
    Scene scene = makeBuiltin("two-boxes");
    scene.pictures.push_back(
        {.name = "stripes", .width_px = 2, .height_px = 1, .rgba = {255, 255, 255, 255, 255, 255, 255, 0}});
    scene.textures.push_back(
        {.picture = int(scene.pictures.size()) - 1, .minFilter = 0x2600, .magFilter = 0x2600});
    for (Mesh& mesh : scene.meshes) {
        mesh.uvs.clear();
        for (const glm::vec3& p : mesh.positions) mesh.uvs.emplace_back(p.x * 2, 0.5f);
    }
    for (Material& material : scene.materials) {
        material.alpha = Material::Alpha::mask;
        material.baseColorTexture = int(scene.textures.size()) - 1;
    }
    const LightResult exact = truth(scene);
    // A hard shadow is off by 0.27; 48 taps show a penumbra in steps of 0.02, and a box has two layers of
    // stripes.
    EXPECT_LE(judge(exact, render("smoothies", scene)).penumbra_rmse, 0.12);
    EXPECT_GE(judge(exact, render("hard", scene)).penumbra_rmse, 0.2);
}

}  // namespace
}  // namespace penumbra::studio
