// SPDX-License-Identifier: Apache-2.0
#include "src/automatic/frame_watch.h"

#include <gtest/gtest.h>

#include <array>

namespace penumbra {
namespace {

AreaLight lamp(float x, float y = 0) {
    AreaLight light{.shape = LightShape::sphere, .radius_m = 0.5f};
    light.worldFromLight.columns[3] = {x, y, 0, 1};
    return light;
}

TEST(FrameWatch, AFrameBeginsWhereALightReturns) {
    FrameWatch watch;
    for (int frame = 0; frame < 3; ++frame) {
        for (int i = 0; i < 4; ++i) EXPECT_EQ(watch.begins({.light = lamp(2.0f * float(i))}), i == 0) << i;
        EXPECT_EQ(watch.lights(), 4u);
    }
}

TEST(FrameWatch, AlsoWhereItHasMoved) {
    FrameWatch watch;
    for (int frame = 0; frame < 30; ++frame) {
        EXPECT_TRUE(watch.begins({.light = lamp(0, 0.1f * float(frame))}));
        EXPECT_FALSE(watch.begins({.light = lamp(8, 0.2f * float(frame))}));
        EXPECT_FALSE(watch.begins({.light = {.shape = LightShape::distant, .angle_rad = 0.01f}}));
    }
}

TEST(FrameWatch, AndWhereTheCameraHas) {
    FrameWatch watch;
    for (int frame = 0; frame < 3; ++frame) {
        ShadowInputs inputs{.light = lamp(10.0f * float(frame))};  // another place in every frame
        inputs.view.viewFromWorld.columns[3][0] = float(frame);
        EXPECT_TRUE(watch.begins(inputs));
        inputs.light = lamp(1000);
        EXPECT_FALSE(watch.begins(inputs));
    }
}

}  // namespace
}  // namespace penumbra
