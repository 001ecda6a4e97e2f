// SPDX-License-Identifier: Apache-2.0
#include "studio/reference/brute_force.h"

#include <gtest/gtest.h>

#include <random>

#include "studio/reference/occlusion_scene.h"
#include "studio/reference/test_scenes.h"

namespace penumbra::studio {
namespace {

TEST(BruteForce, KnownRays) {
    const Soup soup = Soup().triangle({0, 0, 1}, {1, 0, 1}, {0, 1, 1});
    const TracedCaster caster = soup.caster();
    const BruteForceScene scene({&caster, 1});
    EXPECT_TRUE(scene.occluded({0.2, 0.2, 0}, {0, 0, 1}, 2));
    EXPECT_TRUE(scene.occluded({0.2, 0.2, 2}, {0, 0, -1}, 2));
    EXPECT_FALSE(scene.occluded({0.2, 0.2, 0}, {0, 0, 1}, 0.99));
    EXPECT_FALSE(scene.occluded({0.2, 0.2, 0}, {0, 0, -1}, 9));
    EXPECT_FALSE(scene.occluded({0.6, 0.6, 0}, {0, 0, 1}, 2));
    EXPECT_FALSE(scene.occluded({0.2, 0.2, 0}, {1, 0, 0}, 2));
}

TEST(BruteForce, AgreesWithEmbreeOnEveryRayButThoseAtAnEdge) {
    std::mt19937 random(3);
    const auto unit = [&] { return float(random() >> 8) * 0x1p-24f; };
    const auto vector = [&] { return glm::vec3(unit(), unit(), unit()); };
    int blockedCount = 0, edgeCount = 0;
    for (const float size : {0.02f, 0.2f, 2.0f}) {
        const Soup soup = Soup().random(300, glm::vec3(-1), glm::vec3(1), size, 5);
        const TracedCaster caster = soup.caster();
        const OcclusionScene embree({&caster, 1});
        const BruteForceScene brute({&caster, 1});
        for (int fanIndex = 0; fanIndex < 100; ++fanIndex) {
            const glm::vec3 origin = 4.0f * vector() - 2.0f;
            RayFan fan;
            fan.resize(37);  // no multiple of the packet size
            std::vector<glm::vec3> directions;
            for (std::size_t i = 0; i < fan.size(); ++i) {
                directions.push_back(2.0f * vector() - 1.0f - origin);
                fan.set(i, directions.back(), 0.5f + unit());
            }
            std::vector<glm::vec3> passing(fan.size());
            embree.trace(origin, fan, passing);
            for (std::size_t i = 0; i < fan.size(); ++i) {
                blockedCount += passing[i] == glm::vec3(0);
                if (brute.occluded(origin, directions[i], fan.end[i]) == (passing[i] == glm::vec3(0)))
                    continue;
                // Legal only where a nudge of a float's rounding changes the answer.
                ++edgeCount;
                bool seenOpen = false, seenBlocked = false;
                for (int nudge = 0; nudge < 200; ++nudge) {
                    const glm::dvec3 shift = 4e-6 * (2.0 * glm::dvec3(vector()) - 1.0);
                    const double end = fan.end[i] * (1 + 4e-6 * (2 * unit() - 1));
                    (brute.occluded(origin, glm::dvec3(directions[i]) + shift, end) ? seenBlocked
                                                                                    : seenOpen) = true;
                }
                EXPECT_TRUE(seenOpen && seenBlocked) << "fan " << fanIndex << ", ray " << i;
            }
        }
    }
    EXPECT_GT(blockedCount, 1000);
    EXPECT_LT(edgeCount, 5);
}

TEST(BruteForce, AgreesOnTheVisibilityOfEveryShape) {
    const Soup soup = Soup().random(60, {-1, -1, 0.3f}, {1, 1, 1.8f}, 0.7f, 11);
    const TracedCaster caster = soup.caster();
    const BruteForceScene brute({&caster, 1});
    const ReferenceScene scene = soup.scene();

    std::vector<AreaLight> lights{rectAt({0, 0, 2}, 1.5f, 0.8f),
                                  roundAt(LightShape::disk, {0.3f, 0, 2}, 0.7f),
                                  roundAt(LightShape::sphere, {0, 0.4f, 2.2f}, 0.6f),
                                  AreaLight{.shape = LightShape::distant, .angle_rad = 0.5f}};
    lights.push_back(tubeAt({0.2f, 0.1f, 2}, 1.4f, 0.05f));
    lights.push_back(tubeAt({1.1f, 0.5f, 2}, 0.7f, 0.6f));  // seen past an end
    lights.push_back(lights[0]);
    lights.back().twoSided = true;
    // The rect stands upright and reaches through the horizon.
    lights.push_back(rectAt({1.5f, 0, 0.2f}, 1, 1.5f));
    lights.back().worldFromLight.columns = {{{0, 1, 0, 0}, {0, 0, 1, 0}, {1, 0, 0, 0}, {1.5f, 0, 0.2f, 1}}};
    for (const AreaLight& light : lights) {
        ReceiverImage receivers = repeated({0, 0, 0}, {0, 0, 1}, 6, 5);
        for (std::size_t i = 0; i < receivers.posWorld.size(); ++i) {
            receivers.posWorld[i] = {float(i % 6) * 0.2f - 0.5f, float(i / 6) * 0.2f - 0.4f, 0};
        }
        const ReferenceResult result = scene.trace(receivers, light, nullptr, {.samples = 4096});
        double meanDifference = 0;
        for (std::size_t i = 0; i < receivers.posWorld.size(); ++i) {
            const double truth = brute.visibility(receivers.posWorld[i], receivers.normalWorld[i], light, 50);
            const double difference = result.visibility.values[i] - truth;
            EXPECT_NEAR(difference, 0,
                        0.02);  // 2500 regular samples: an edge may cut a row of them differently
            meanDifference += difference / 30;
        }
        EXPECT_NEAR(meanDifference, 0, 0.003);
    }
}

}  // namespace
}  // namespace penumbra::studio
