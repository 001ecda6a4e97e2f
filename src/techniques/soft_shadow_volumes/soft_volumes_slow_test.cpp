// SPDX-License-Identifier: Apache-2.0
// Many pictures, for what is wrong in one of thousands: labelled slow.
#include <glm/gtc/matrix_transform.hpp>

#include "src/device/glm_types.h"
#include "studio/scene/builtin/builtin.h"
#include "tests/support/random_ground.h"
#include "tests/support/technique_test.h"
#include "tests/support/wrong_pixels.h"

namespace penumbra::studio {
namespace {

class SoftVolumesSlowTest : public TechniqueTest {};

constexpr PictureSize small{160, 90};

/// Camera and light go around the scene, the light faster; what moves by itself goes on moving.
Scene wandering(Scene scene, int frame) {
    return withMoment(std::move(scene), [=](SceneMoment& moment) {
        const auto turned = [](float angle_rad) {
            return glm::rotate(glm::mat4(1), angle_rad, glm::vec3(0, 1, 0));
        };
        Camera& camera = moment.cameras.front();
        camera.worldFromCamera = turned(0.0628f * float(frame)) * camera.worldFromCamera;
        for (Light& light : moment.lights) {
            const glm::mat4 world =
                turned(-0.11f * float(frame)) * glm::mat4(toGlm(light.shape.worldFromLight));
            light.shape.worldFromLight = Mat4::fromColumns(&world[0][0]);
        }
    });
}

TEST_F(SoftVolumesSlowTest, HardlyAPixelIsWrongByItselfInAHundredFrames) {
    constexpr int frames = 100;
    int wrong = 0;
    for (int frame = 0; frame < frames; ++frame) {
        const Scene scene = wandering(makeBuiltin("moving"), frame);
        const double time_s = 4.0 * frame / frames;
        const LightResult right =
            render("reference", scene, small, {{"samples", "256"}, {"cache", "false"}}, time_s);
        const LightResult exact = render("exact", scene, small, {}, time_s);
        wrong += wrongSinglePixels(right, render("soft-volumes", scene, small, {}, time_s), &exact);
    }
    // Of 1,440,000: see the room's README, known artefacts.
    EXPECT_LE(wrong, 4);
}

TEST_F(SoftVolumesSlowTest, MorePointsMakeNoMorePixelsWrong) {
    const Scene scene = makeBuiltin("primitives");
    constexpr PictureSize large{320, 180};
    const LightResult right = truth(scene, large), exact = render("exact", scene, large);
    for (const char* samples : {"16", "17", "33", "64", "100", "128", "256", "512", "1024"}) {
        const LightResult result = render("soft-volumes", scene, large, {{"samples", samples}});
        // One, whatever the number: see the room's README, known artefacts.
        EXPECT_LE(wrongSinglePixels(right, result, &exact), 1) << samples;
    }
}

TEST_F(SoftVolumesSlowTest, GroundsOfBoxesHideNothingOfThemselves) {
    const std::unique_ptr<Technique> technique = workbench().makeTechnique("soft-volumes");
    for (std::uint32_t seed = 0; seed < 2000; ++seed) {
        const RandomGround ground = makeRandomGround(seed);
        const Image casting = render(*technique, ground.casting, {64, 40}).visibility;
        const Image receiving = render(*technique, ground.receiving, {64, 40}).visibility;
        int darker = 0;
        for (std::size_t i = 0; i < casting.values.size(); ++i)
            darker += !(casting.values[i] >= receiving.values[i] - 0.1f);
        EXPECT_EQ(darker, 0) << ground.description;
    }
}

}  // namespace
}  // namespace penumbra::studio
