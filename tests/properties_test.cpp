// SPDX-License-Identifier: Apache-2.0
// Properties that hold whatever the truth is, for the techniques that decide every point of the light by
// itself. The camera looks at the ground from beneath the blockers, so that these change no receiver.
#include <algorithm>
#include <cmath>
#include <functional>

#include "studio/scene/builtin/mesh_kit.h"
#include "studio/scene/builtin/placing.h"
#include "studio/scene/builtin/scene_builder.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

struct Blocker {
    glm::vec3 center{0, 1.5f, 0}, size{0.5f};
};
const Blocker left{{-0.25f, 1.4f, 0.05f}, {0.6f, 0.1f, 0.9f}};
const Blocker right{{0.3f, 1.8f, -0.1f},
                    {0.5f, 0.2f, 0.6f}};  // partly behind the other, as seen from the ground

/// One side of the world, and the other where `mirror` is -1.
Scene scene(const std::vector<Blocker>& blockers, const Light& light, float mirror = 1) {
    SceneBuilder builder("properties");
    builder.ground(8);
    for (const Blocker& blocker : blockers) {
        const int mesh = builder.mesh("blocker", box(blocker.size), glm::vec3(0.5f));
        builder.place("blocker", mesh, at(blocker.center * glm::vec3(mirror, 1, 1)));
    }
    builder.light(light);
    builder.camera(camera("eye", {mirror * 0.2f, 1.0f, 2.2f}, {0, 0, 0}, 0.8f));
    return std::move(builder).build();
}

Light panel(float width_m = 0.8f, float x = 0.1f) {
    return rectLight("panel", width_m, 0.6f, {x, 3, 0}, {x, 0, 0}, 1000);
}
Light lamp(float radius_m) {
    return diskLight("lamp", radius_m, {0.1f, 3, 0}, {0.1f, 0, 0}, 1000);
}

class Properties : public TechniqueTest, public testing::WithParamInterface<const char*> {
  protected:
    static constexpr PictureSize size{64, 48};

    static Image visibility(const Scene& scene) {
        const std::string name = GetParam();
        const LightResult result = name == "reference" ? truth(scene, size) : render(name, scene, size);
        // The sky and the far ground are no part of it.
        EXPECT_GT(std::ranges::count_if(result.reach.values, [](float e) { return e > 0; }), 1000);
        return result.visibility;
    }

    /// Maps have texels, whose places follow from what is in the scene: a few pixels of their shadows' edges
    /// move.
    static double allowedShare() { return std::string(GetParam()) == "uniform" ? 0.02 : 0; }

    /// Soft volumes know from the exact areas of edges what is hidden between their 64 points; where edges of
    /// several blockers meet, to half of what a point stands for.
    static float rounding() { return std::string(GetParam()) == "soft-volumes" ? 0.5f / 64 : 1e-4f; }

    static double share(const Image& a, const std::function<bool(std::size_t)>& isWrong) {
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < a.values.size(); ++i) wrong += isWrong(i);
        return double(wrong) / double(a.values.size());
    }
};

TEST_P(Properties, ABlockerMoreNeverLightens) {
    const Image none = visibility(scene({}, panel())), one = visibility(scene({left}, panel())),
                both = visibility(scene({left, right}, panel()));
    EXPECT_EQ(share(none, [&](std::size_t i) { return none.values[i] != 1; }), 0);
    EXPECT_GT(share(one, [&](std::size_t i) { return one.values[i] < 0.5f; }), 0.02) << "nothing is blocked";
    EXPECT_GT(share(one, [&](std::size_t i) { return both.values[i] < one.values[i] - 0.2f; }), 0.02)
        << "the second blocker blocks nothing more";
    EXPECT_LE(share(one, [&](std::size_t i) { return !(both.values[i] <= one.values[i] + rounding()); }),
              allowedShare());
}

TEST_P(Properties, TwoBlockersAreAUnion) {
    const Image one = visibility(scene({left}, panel())), other = visibility(scene({right}, panel())),
                both = visibility(scene({left, right}, panel()));
    const auto isOutside = [&](std::size_t i) {
        const float a = one.values[i], b = other.values[i], low = std::max(0.0f, a + b - 1),
                    high = std::min(a, b);
        return !(both.values[i] >= low - rounding() && both.values[i] <= high + rounding());
    };
    EXPECT_LE(share(one, isOutside), allowedShare());
    // A product would lie between the bounds, too, but not on them where one hides behind the other.
    EXPECT_GT(share(one,
                    [&](std::size_t i) {
                        const float product = one.values[i] * other.values[i];
                        return std::abs(both.values[i] - product) > 0.05f;
                    }),
              0.01);
}

TEST_P(Properties, TheSameBlockerTwiceChangesNothing) {
    const Image once = visibility(scene({left}, panel())), twice = visibility(scene({left, left}, panel()));
    const auto isOther = [&](std::size_t i) {
        const float difference = std::abs(once.values[i] - twice.values[i]);
        return std::string(GetParam()) == "soft-volumes" ? difference > rounding() : difference != 0;
    };
    EXPECT_EQ(share(once, isOther), 0);
}

TEST_P(Properties, UmbraAndLitGroundOfALargeLightAreThoseOfASmallOneInIt) {
    const Image large = visibility(scene({left, right}, lamp(0.4f))),
                small = visibility(scene({left, right}, lamp(0.2f)));
    // What is dark or lit for 64 points of the large light is nearly so for all of it.
    const auto isWrong = [&](std::size_t i) {
        return (large.values[i] == 0 && small.values[i] > 0.1f) ||
               (large.values[i] == 1 && small.values[i] < 0.9f);
    };
    EXPECT_LE(share(large, isWrong), 0.005);
}

TEST_P(Properties, TheMirroredSceneIsTheMirroredPicture) {
    Light mirrored = panel(0.8f, -0.1f);
    const Image plain = visibility(scene({left, right}, panel())),
                other = visibility(scene({left, right}, mirrored, -1));
    double squares = 0;
    for (int y = 0; y < size.height_px; ++y) {
        for (int x = 0; x < size.width_px; ++x) {
            const std::size_t row = std::size_t(y) * std::size_t(size.width_px);
            const float difference =
                plain.values[row + std::size_t(x)] - other.values[row + std::size_t(size.width_px - 1 - x)];
            squares += double(difference) * difference;
        }
    }
    // The light's points are not mirrored with it: what 64 of them differ by from its area, twice.
    EXPECT_LE(std::sqrt(squares / double(plain.values.size())), 0.02);
}

TEST_P(Properties, ADiskMayBeTurnedAboutItsAxis) {
    Light turned = lamp(0.4f);
    auto& columns = turned.shape.worldFromLight.columns;
    const auto x = columns[0], y = columns[1];
    for (int i = 0; i < 3; ++i) {
        columns[0][i] = 0.8f * x[i] + 0.6f * y[i];
        columns[1][i] = -0.6f * x[i] + 0.8f * y[i];
    }
    const Image plain = visibility(scene({left, right}, lamp(0.4f))),
                other = visibility(scene({left, right}, turned));
    double squares = 0;
    for (std::size_t i = 0; i < plain.values.size(); ++i) {
        squares += std::pow(double(plain.values[i]) - other.values[i], 2);
    }
    // Two sets of 64 points, each of which promises 0.028 in the penumbra.
    EXPECT_LE(std::sqrt(squares / double(plain.values.size())), 0.028);
}

INSTANTIATE_TEST_SUITE_P(OfTechniques, Properties,
                         testing::Values("reference", "exact", "soft-volumes", "uniform"),
                         [](const auto& test) {
                             std::string name = test.param;
                             std::ranges::replace(name, '-', '_');
                             return name;
                         });

}  // namespace
}  // namespace penumbra::studio
