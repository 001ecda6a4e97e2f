// SPDX-License-Identifier: Apache-2.0
#include "tests/support/against_hard.h"

namespace penumbra::studio {
namespace {

using SmoothiesAgainstHardTest = AgainstHardTest;

TEST_F(SmoothiesAgainstHardTest, IsNoWorseWhereGroundsCast) {
    expectNoWorseInBuiltinScenes("smoothies");
}

/// A sun low above posts: leaks of 1.7 % with a map for the whole picture.
TEST_F(SmoothiesAgainstHardTest, IsNoWorseInScenesOfTheField) {
    expectNoWorseInTheField("smoothies", {"room-0",           "room-1mm",      "room-bulb",
                                          "lowsun-e1",        "lowsun-e5",     "terminator-terminator",
                                          "cube-large",       "lamp-shade",    "city-triangle",
                                          "pillar-base",      "pillar-yaw20",  "mirror-mirror",
                                          "close-wallwasher", "desk-ww",       "ceiling-h27",
                                          "fixture-fixture",  "pcss-wall-2.5", "window-open",
                                          "lamp-bulb",        "ground-boxes"});
}

}  // namespace
}  // namespace penumbra::studio
