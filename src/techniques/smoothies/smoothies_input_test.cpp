// SPDX-License-Identifier: Apache-2.0
// Blockers and lights that are not as the paper assumes (closed, away from the light, in front of it).
#include <algorithm>
#include <cmath>
#include <numbers>

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
        expectNearTheTruth(blockedBy(blocker), penumbraRmse);
    }
    static void expectNearTheTruth(const Scene& scene, double penumbraRmse) {
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

/// A closed box between two corners.
Triangles boxOf(glm::vec3 low, glm::vec3 high) {
    Triangles box{{}, {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                       2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5}};
    for (int i = 0; i < 8; ++i) {
        box.positions.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    }
    return box;
}

void append(Triangles& all, const Triangles& more) {
    for (const std::uint32_t index : more.indices) {
        all.indices.push_back(std::uint32_t(all.positions.size()) + index);
    }
    all.positions.insert(all.positions.end(), more.positions.begin(), more.positions.end());
}

// What the technique promises under small lights, and half of that where edges are straight.
constexpr double curvedEdges = 0.06, straightEdges = 0.03;

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
    const Triangles box = boxOf({-0.7f, 3.3f, -0.7f}, {0.7f, 4.7f, 0.7f});
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

/// What else may be wrong with a mesh: parts that meet but for rounding, vertices in the middle of others'
/// edges, surfaces with one side, solids that go through each other. None lets light through, none hides any.
TEST_F(SmoothiesInputTest, SeamsAndOneSidedSurfacesCastTheirShadow) {
    // Left and right of x = -0.5, whose shadow lies in the umbra.
    const float seam = -0.5f, beside = std::nextafter(seam, 0.0f);
    Triangles parts = sheet({-3, 2, -6}, {-3, 2, 6}, {seam, 2, 6}, {seam, 2, -6});
    append(parts, sheet({beside, 2, -6}, {beside, 2, 6}, {0, 2, 6}, {0, 2, -6}));
    expectNearTheTruth(parts, straightEdges);

    // The right part's border has a vertex where the left one's has none.
    Triangles junction = sheet({-3, 2, -6}, {-3, 2, 6}, {seam, 2, 6}, {seam, 2, -6});
    append(junction, {{{seam, 2, -6}, {seam, 2, 0.3f}, {seam, 2, 6}, {0, 2, 6}, {0, 2, -6}},
                      {0, 1, 4, 1, 3, 4, 1, 2, 3}});
    expectNearTheTruth(junction, straightEdges);

    // Once around with half a turn, under a light that is small against it.
    Triangles moebius;
    constexpr int steps = 24;
    for (int i = 0; i < steps; ++i) {
        const float turn = 2 * std::numbers::pi_v<float> * float(i) / steps;
        for (const float side : {-0.4f, 0.4f}) {
            const float radius_m = 0.55f + side * std::cos(0.5f * turn);
            moebius.positions.emplace_back(radius_m * std::cos(turn), 2 + side * std::sin(0.5f * turn),
                                           radius_m * std::sin(turn));
        }
        const auto a = std::uint32_t(2 * i), next = std::uint32_t(2 * ((i + 1) % steps));
        const std::uint32_t b = i + 1 < steps ? next : 1, c = i + 1 < steps ? next + 1 : 0;
        moebius.indices.insert(moebius.indices.end(), {a, a + 1, b, a + 1, c, b});
    }
    expectNearTheTruth(withLight(blockedBy(moebius),
                                 [](Light& light) { light.shape.width_m = light.shape.height_m = 0.2f; }),
                       curvedEdges);

    // A second sheet, tilted, goes through the first along the seam.
    Triangles crossing = level;
    append(crossing, sheet({-1, 1.9f, -6}, {-1, 1.9f, 6}, {-0.2f, 2.06f, 6}, {-0.2f, 2.06f, -6}));
    expectNearTheTruth(crossing, straightEdges);
}

/// Scaled to nothing along one axis, a box is a sheet; along all, nothing.
TEST_F(SmoothiesInputTest, FlattenedInstancesCastFlatShadows) {
    const Triangles box = boxOf({-3, 1.8f, -6}, {0, 2.2f, 6});
    const auto scaled = [&](glm::vec3 scale) {
        return withMoment(blockedBy(box), [=](SceneMoment& moment) {
            for (Instance& instance : moment.instances) {
                if (isGround(instance)) continue;
                for (int i = 0; i < 3; ++i) instance.worldFromMesh[i] *= scale[i];
                instance.worldFromMesh[3] = {0, 2 - 2 * scale.y, 0, 1};
            }
        });
    };
    const Scene flat = scaled({1, 0, 1});
    EXPECT_LE(judge(truth(flat), render("smoothies", flat)).penumbra_rmse, straightEdges);
    const LightResult nothing = render("smoothies", scaled({0, 0, 0}));
    EXPECT_TRUE(std::ranges::all_of(nothing.visibility.values, [](float v) { return v == 1; }));
}

/// Bars with gaps as wide as they are, many of them in front of the light at once: half of it is seen,
/// wherever the receiver stands. No single edge tells that, nor any four of them.
TEST_F(SmoothiesInputTest, ManyThinBlockersAddUp) {
    Triangles bars;
    for (int i = -40; i < 40; ++i) {
        const float x = 0.1f * float(i);
        append(bars, sheet({x, 2, -6}, {x, 2, 6}, {x + 0.05f, 2, 6}, {x + 0.05f, 2, -6}));
    }
    const Image seen = render("smoothies", blockedBy(bars)).visibility;
    double squares = 0;
    for (const float v : seen.values) squares += std::pow(v - 0.5, 2);
    // Points of the light are 32; where edges agree with them within 0.05, edges count.
    EXPECT_LE(std::sqrt(squares / double(seen.values.size())), 0.1);
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
    Scene scene = withAlphaMask(
        makeBuiltin("two-boxes"),
        {.name = "stripes", .width_px = 2, .height_px = 1, .rgba = {255, 255, 255, 255, 255, 255, 255, 0}});
    for (Mesh& mesh : scene.meshes) {
        mesh.uvs.clear();
        for (const glm::vec3& p : mesh.positions) mesh.uvs.emplace_back(p.x * 2, 0.5f);
    }
    const LightResult exact = truth(scene);
    // A hard shadow is off by 0.27; 48 taps show a penumbra in steps of 0.02, and a box has two layers of
    // stripes.
    EXPECT_LE(judge(exact, render("smoothies", scene)).penumbra_rmse, 0.12);
    EXPECT_GE(judge(exact, render("hard", scene)).penumbra_rmse, 0.2);
    // Where texels are half as wide as stripes, masks get finer ones; without, the error is 0.3.
    const LightResult coarse = render("smoothies", scene, defaultSize, {{"map_size", "64"}});
    EXPECT_LE(judge(exact, coarse).penumbra_rmse, 0.24);
}

}  // namespace
}  // namespace penumbra::studio
