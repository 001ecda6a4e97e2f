// SPDX-License-Identifier: Apache-2.0
// Casters that let a share of the light pass. What passes several panes is a product, so that visibility
// behind panes follows from what each of them hides when it is opaque, sample by sample: V = 1 - (1 - t) (1 -
// V opaque) behind one.
#include <algorithm>
#include <array>
#include <memory>

#include "studio/scene/builtin/builtin.h"
#include "studio/scene/open_scene.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

/// What half floats and 16 bits a pane lose.
constexpr float rounding = 1.5e-3f;

constexpr glm::vec3 tint{0.5f, 0.8f, 0.0625f};

/// Says what the instance of this place among those that are not the ground does.
using Change = std::function<void(Instance& instance, std::size_t place)>;

Scene with(Scene scene, const Change& change) {
    return withMoment(std::move(scene), [change](SceneMoment& moment) {
        std::size_t place = 0;
        for (Instance& instance : moment.instances)
            if (!isGround(instance)) change(instance, place++);
    });
}

Scene allPanes(Scene scene, const glm::vec3& passes) {
    return with(std::move(scene),
                [passes](Instance& instance, std::size_t) { instance.transmittance = passes; });
}

/// All different.
glm::vec3 tintOf(std::size_t place) {
    const auto share = [&](std::size_t factor) { return 0.3f + 0.65f * float(place * factor % 11) / 10; };
    return {share(3), share(5), share(7)};
}

float channelOf(const Image& image, int x, int y, int channel) {
    return image.at(x, y, std::min(channel, image.channels - 1));
}

class PanesTest : public TechniqueTest {
  protected:
    static constexpr PictureSize size{96, 72};

    static LightResult exact(const Scene& scene, const Settings& settings = {}) {
        return render("exact", scene, size, settings);
    }

    /// Every pixel that the light reaches is what `expected` makes of the channel and the pixel of other
    /// pictures.
    static void expectPixels(const LightResult& result,
                             const std::function<float(int x, int y, int channel)>& expected,
                             const std::string& what) {
        const Image& found = result.visibility;
        ASSERT_EQ(found.channels, 3) << what;
        int wrong = 0;
        float worst = 0;
        std::string where;
        for (int y = 0; y < found.height_px; ++y) {
            for (int x = 0; x < found.width_px; ++x) {
                // Where the light is below the horizon nothing is seen of it, whatever stands before it.
                for (int c = 0; c < 3 && result.reach.at(x, y) > 0; ++c) {
                    const float error = std::abs(found.at(x, y, c) - expected(x, y, c));
                    wrong += !(error <= rounding);
                    if (error > worst) where = std::to_string(x) + ", " + std::to_string(y);
                    worst = std::max(worst, error);
                }
            }
        }
        EXPECT_EQ(wrong, 0) << what << ": off by up to " << worst << " at " << where;
    }

    /// What casts in `opaque`, all of it as one pane or as many of which no two stand one behind the other:
    /// of what it hides of what is seen without it, the pane's share is seen.
    static void expectOnePane(const Scene& opaque, const std::string& what, const Settings& settings = {}) {
        const Image hidden = exact(opaque, settings).visibility;
        const Scene without = with(opaque, [](Instance& instance, std::size_t) { instance.casts = false; });
        const Image seen = exact(without, settings).visibility;
        expectPixels(
            exact(allPanes(opaque, tint), settings),
            [&](int x, int y, int c) {
                const float all = channelOf(seen, x, y, c);
                return all - (1 - tint[c]) * (all - channelOf(hidden, x, y, c));
            },
            what);
    }
};

TEST_F(PanesTest, HalfALightBehindAPane) {
    // The blocker's edge stands below the light's middle, where half of it is hidden.
    const LightResult result = exact(allPanes(makeBuiltin("half-plane"), glm::vec3(0.5f)));
    const Image opaque = exact(makeBuiltin("half-plane")).visibility;
    int halves = 0;
    for (int y = 0; y < size.height_px; ++y) {
        for (int x = 0; x < size.width_px; ++x) {
            if (std::abs(opaque.at(x, y) - 0.5f) > 0.02f) continue;
            ++halves;
            EXPECT_NEAR(result.visibility.at(x, y, 0), 0.75f, 0.011f);
        }
    }
    EXPECT_GT(halves, 0);
}

// A sphere, a torus and boxes are closed: rays go in and out, and some of a torus twice.
TEST_F(PanesTest, OneCasterCountsOnce) {
    for (const char* name : {"half-plane", "strip", "sphere", "torus", "disk-over-ground"}) {
        const Scene scene = makeBuiltin(name);
        expectOnePane(scene, name);
    }
}

TEST_F(PanesTest, EveryShapeOfLightAndEveryWeight) {
    for (const LightShape shape : {LightShape::rect, LightShape::disk, LightShape::sphere,
                                   LightShape::distant, LightShape::cylinder}) {
        for (const bool isWide : {false, true}) {
            const Scene scene = withLight(makeBuiltin("torus"), [&](Light& light) {
                light.shape.shape = shape;
                light.shape.radius_m = isWide ? 40.0f : 0.3f;
                light.shape.length_m = 1;
                if (shape == LightShape::cylinder) light.shape.radius_m = 0.3f;
                light.shape.angle_rad = isWide ? 3.0f : 0.2f;
            });
            for (const char* weight : {"area", "irradiance"})
                expectOnePane(scene, std::to_string(int(shape)) + weight, {{"weight", weight}});
        }
    }
}

TEST_F(PanesTest, TexturedLightHasBothColours) {
    expectOnePane(with(makeBuiltin("textured-window"),
                       [](Instance& instance, std::size_t place) { instance.casts = place == 0; }),
                  "textured-window");
}

// By what two casters hide alone and together it is known what both of them hide, whatever lets light
// through.
TEST_F(PanesTest, SeveralMultiply) {
    const Scene scene = makeBuiltin("two-boxes");
    const auto casting = [&](bool first, bool second, const glm::vec3& s, const glm::vec3& t) {
        return with(scene, [=](Instance& instance, std::size_t place) {
            instance.casts = place == 0 ? first : second;
            instance.transmittance = place == 0 ? s : t;
        });
    };
    constexpr glm::vec3 none(0);
    const Image first = exact(casting(true, false, none, none)).visibility;
    const Image second = exact(casting(false, true, none, none)).visibility;
    const Image both = exact(casting(true, true, none, none)).visibility;
    int overlaps = 0;
    const auto expectProduct = [&](const glm::vec3& s, const glm::vec3& t, const std::string& what) {
        expectPixels(
            exact(casting(true, true, s, t)),
            [&](int x, int y, int c) {
                const float a = 1 - first.at(x, y), b = 1 - second.at(x, y), ab = a + b - (1 - both.at(x, y));
                overlaps += ab > 0.1f && ab < 0.9f;
                return 1 - (1 - s[c]) * a - (1 - t[c]) * b + (1 - s[c]) * (1 - t[c]) * ab;
            },
            what);
    };
    const glm::vec3 other{0.9f, 0.25f, 0.6f};
    expectProduct(tint, other, "two panes");
    expectProduct(other, tint, "the other way round");
    expectProduct(none, tint, "an opaque one before a pane");
    expectProduct(tint, none, "a pane before an opaque one");
    EXPECT_GT(overlaps, 100);
}

TEST_F(PanesTest, OrderDoesNotMatter) {
    const Scene scene = with(makeBuiltin("primitives"), [](Instance& instance, std::size_t place) {
        instance.transmittance = tintOf(place);
    });
    const Scene turned =
        withMoment(scene, [](SceneMoment& moment) { std::ranges::reverse(moment.instances); });
    const Image found = exact(turned).visibility;
    expectPixels(
        exact(scene), [&](int x, int y, int c) { return found.at(x, y, c); }, "reversed");
}

TEST_F(PanesTest, IsNearTheReference) {
    for (const char* name : {"primitives", "overlapping-blockers", "columns", "sunny-window"}) {
        const Scene scene = with(makeBuiltin(name), [](Instance& instance, std::size_t place) {
            if (place % 3 != 2) instance.transmittance = tintOf(place);
        });
        const VisibilityMetrics metrics = judge(truth(scene, size, 512), exact(scene));
        EXPECT_LE(metrics.penumbra_rmse, 0.025) << name;
        EXPECT_LE(metrics.false_shadow, 0.001) << name;
    }
}

TEST_F(PanesTest, RoomAndRoundsChangeNoBit) {
    for (const char* samples : {"64", "512"}) {
        const Scene scene = with(makeBuiltin("primitives"), [](Instance& instance, std::size_t place) {
            if (place % 2 == 0) instance.transmittance = tintOf(place);
        });
        const LightResult plain = exact(scene, {{"samples", samples}});
        EXPECT_EQ(plain.visibility.values,
                  exact(scene, {{"samples", samples}, {"tile_candidates", "1"}}).visibility.values);
        EXPECT_EQ(plain.visibility.values,
                  exact(scene, {{"samples", samples}, {"tile_candidates", "7"}, {"round_work", "2000"}})
                      .visibility.values);
    }
}

// A pane with holes: where they are, all of the light passes.
TEST_F(PanesTest, HolesLetAllOfItThrough) {
    Picture leaf{"leaf", 2, 2, std::vector<std::uint8_t>(16, 255)};
    leaf.rgba[3] = leaf.rgba[15] = 0;
    Scene scene = makeBuiltin("two-boxes");
    for (Mesh& mesh : scene.meshes) {
        mesh.uvs.clear();
        for (const glm::vec3& position : mesh.positions)
            mesh.uvs.emplace_back(4 * position.x, 4 * position.z);
    }
    scene = withAlphaMask(scene, leaf);
    expectOnePane(with(scene, [](Instance& instance, std::size_t place) { instance.casts = place == 1; }),
                  "holes");
}

TEST_F(PanesTest, EdgesOfPanesAreInTheErrorBound) {
    const auto edges = [](const LightResult& result) {
        const auto found = std::ranges::find(result.statistics.counts, "mean error bound", &Statistic::name);
        return found->value;
    };
    const double opaque = edges(exact(makeBuiltin("half-plane")));
    for (const float passes : {0.25f, 0.75f})
        EXPECT_NEAR(edges(exact(allPanes(makeBuiltin("half-plane"), glm::vec3(passes)))),
                    (1 - double(passes)) * opaque, 0.02 * opaque);
}

// A kept answer is of the panes as they were.
TEST_F(PanesTest, AnotherTransmittanceIsSeenInAStillView) {
    const auto technique = workbench().makeTechnique("exact");
    for (const float passes : {0.5f, 0.5f, 0.5f, 0.25f, 0.0f, 0.75f}) {
        const Scene scene = allPanes(makeBuiltin("sphere"), glm::vec3(passes));
        EXPECT_EQ(render(*technique, scene, size).visibility.values, exact(scene).visibility.values)
            << passes;
    }
}

TEST_F(PanesTest, OthersTakePanesForNoCasters) {
    const Scene panes = allPanes(makeBuiltin("two-boxes"), tint);
    const Scene without =
        with(makeBuiltin("two-boxes"), [](Instance& instance, std::size_t) { instance.casts = false; });
    for (const TechniqueInfo& info : techniqueCatalog()) {
        const std::string name(info.name);
        const auto technique = workbench().makeTechnique(name);
        if (technique->answersPanes()) continue;
        const Image plain = render(name, without, size).visibility;
        const LightResult found = render(name, panes, size);
        expectPixels(
            found, [&](int x, int y, int) { return plain.at(x, y); }, name);
    }
}

TEST_F(PanesTest, AutoTakesOneThatAnswersThem) {
    const Settings lax = {{"max_error", "0.5"}};
    const Scene scene = makeBuiltin("two-boxes"), panes = allPanes(scene, tint);
    EXPECT_NE(render("auto", scene, size, lax).statistics.chosen.technique, "exact");
    const LightResult result = render("auto", panes, size, lax);
    EXPECT_EQ(result.statistics.chosen.technique, "exact");
    EXPECT_EQ(result.visibility.values,
              exact(panes, {{"samples", std::string(result.statistics.chosen.value)}}).visibility.values);
}

TEST_F(PanesTest, TintedGlassOfTheFieldIsTheReferences) {
    const auto field = fieldScenes();
    if (!field) GTEST_SKIP() << "the scenes from the field are not at hand";
    for (const auto& [name, passes] : {std::pair{"glass-tint.glb", glm::vec3(0.95f, 0.19f, 0.095f)},
                                       {"glass-blend.glb", glm::vec3(0.9f)},
                                       {"window-blend.glb", glm::vec3(0.9f)},
                                       {"window-transmission.glb", glm::vec3(0.8f, 0.9f, 1)}}) {
        const Scene scene = openScene((*field / name).string(), {.reading = {.glass = Glass::tinted}});
        const LightResult reference = truth(scene, size, 512), result = exact(scene);
        EXPECT_LE(judge(reference, result).rmse, 0.02) << name;
        // Drawn as glass, whatever it does to light.
        const Scene transparent = openScene((*field / name).string(), {.reading = {.glass = Glass::clear}});
        const Image clear = exact(transparent).visibility;
        const Image blocked = exact(with(transparent, [](Instance& instance, std::size_t) {
                                  instance.casts = true;
                              })).visibility;
        expectPixels(
            result,
            [&](int x, int y, int c) {
                return clear.at(x, y) + (passes[c] - 1) * (clear.at(x, y) - blocked.at(x, y));
            },
            name);
    }
}

}  // namespace
}  // namespace penumbra::studio
