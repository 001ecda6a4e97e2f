// SPDX-License-Identifier: Apache-2.0
// Coarse meshes that are shaded smoothly: with View::shadingNormalTexture their shadow is the smooth
// surface's.
#include <cmath>

#include "studio/scene/builtin/mesh_kit.h"
#include "studio/scene/builtin/placing.h"
#include "studio/scene/builtin/scene_builder.h"
#include "studio/workbench/reference_inputs.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

constexpr PictureSize size{128, 96};
constexpr float radius_m = 1, sunWidth_rad = 0.009f;
const glm::vec3 center(0, radius_m, 0), towardsSun = glm::normalize(glm::vec3(1, 0.45f, 0.25f));

/// A ball of 16 meridians on the ground, seen from where half of it is dark.
Scene coarseBall() {
    SceneBuilder scene("coarse-ball");
    scene.ground(16);
    scene.place("ball", scene.mesh("ball", sphere(radius_m, 16, 8), glm::vec3(0.5f)), at(center));
    scene.light(distantLight("sun", sunWidth_rad, -towardsSun, 1000));
    scene.camera(camera("front", {-0.8f, 2.2f, 5}, {0, 0.9f, 0}, 0.6f));
    return std::move(scene).build();
}

/// A ball with a lid on it, a tilted ring that shadows itself, and a pillar; of meshes that are so many times
/// as fine.
Scene shapes(int refinement) {
    SceneBuilder scene("shapes");
    scene.ground(16);
    const glm::vec3 grey(0.5f);
    const int around = 14 * refinement, across = 7 * refinement;
    scene.place("ball", scene.mesh("ball", sphere(0.8f, around, across), grey), at({-1.4f, 0.8f, 0}));
    scene.place("lid", scene.mesh("lid", plane(0.9f, 0.9f), grey), at({-1.4f, 1.6f, 0}));
    scene.place("ring", scene.mesh("ring", torus(0.6f, 0.25f, around, across), grey),
                at({0.4f, 0.9f, -0.1f}, 0.9f, {1, 0, 0}));
    scene.place("pillar", scene.mesh("pillar", cylinder(0.4f, 1.6f, around), grey), at({1.8f, 0.8f, 0}));
    scene.light(rectLight("lamp", 0.4f, 0.4f, {5, 2.5f, 1}, {0, 0.8f, 0}, 1000));
    scene.camera(camera("front", {0, 2, 6}, {0, 0.8f, 0}, 0.6f));
    return std::move(scene).build();
}

struct Seen {
    Image visibility;
    ReceiverImage receivers;
};

class SmoothShapes : public TechniqueTest {
  protected:
    static Seen see(const std::string& technique, const Scene& scene, bool isSmooth,
                    const Settings& settings = {}) {
        workbench().frame().setSmoothTerminator(isSmooth);
        Seen seen{render(technique, scene, size, settings).visibility,
                  readReceivers(workbench().frame().gbuffer().view())};
        workbench().frame().setSmoothTerminator(false);
        return seen;
    }
    static bool isOnGround(const ReceiverImage& receivers, std::size_t pixel) {
        return receivers.posWorld[pixel].y < 1e-3f;
    }
};

class Terminator : public SmoothShapes, public ::testing::WithParamInterface<std::string> {};
INSTANTIATE_TEST_SUITE_P(Techniques, Terminator, everyTechnique(), techniqueTestName);

TEST_P(Terminator, IsThatOfTheSmoothSurface) {
    const auto [faceted, receivers] = see(GetParam(), coarseBall(), false);
    const Image smooth = see(GetParam(), coarseBall(), true).visibility;
    double facetedError = 0, smoothError = 0, ball = 0, groundChange = 0, ground = 0;
    for (std::size_t i = 0; i < receivers.valid.size(); ++i) {
        if (!receivers.valid[i]) continue;
        if (isOnGround(receivers, i)) {
            groundChange += std::abs(faceted.values[i] - smooth.values[i]);
            ++ground;
            continue;
        }
        const float sine = glm::dot(glm::normalize(glm::vec3(receivers.posWorld[i]) - center), towardsSun);
        if (std::abs(sine) < sunWidth_rad) continue;  // the sun crosses the horizon
        const float truth = sine > 0 ? 1 : 0;
        facetedError += std::abs(faceted.values[i] - truth);
        smoothError += std::abs(smooth.values[i] - truth);
        ++ball;
    }
    EXPECT_GT(facetedError / ball, 0.02);
    EXPECT_LT(smoothError / ball, 0.002);
    EXPECT_EQ(groundChange / ground, 0) << "flat faces are as they were";
}

/// Judged by rays on meshes a dozen times as fine.
TEST_F(SmoothShapes, AreNearTheReferenceOnFineOnes) {
    const auto [truth, fine] = see("reference", shapes(12), false, {{"samples", "256"}, {"cache", "false"}});
    const auto [faceted, coarse] = see("exact", shapes(1), false);
    const Image smooth = see("exact", shapes(1), true).visibility;
    double facetedError = 0, smoothError = 0, leaks = 0, pixels = 0;
    for (std::size_t i = 0; i < truth.values.size(); ++i) {
        if (!fine.valid[i] || !coarse.valid[i] || isOnGround(fine, i) || isOnGround(coarse, i)) continue;
        facetedError += std::abs(faceted.values[i] - truth.values[i]);
        smoothError += std::abs(smooth.values[i] - truth.values[i]);
        leaks += smooth.values[i] > truth.values[i] + 0.5f && smooth.values[i] > faceted.values[i] + 0.5f;
        ++pixels;
    }
    RecordProperty("faceted", std::to_string(facetedError / pixels));
    RecordProperty("smooth", std::to_string(smoothError / pixels));
    RecordProperty("leaks", std::to_string(leaks / pixels));
    EXPECT_LT(smoothError, 0.4 * facetedError);
    EXPECT_LT(leaks / pixels, 0.005);
}

}  // namespace
}  // namespace penumbra::studio
