// SPDX-License-Identifier: Apache-2.0
#include "tests/support/against_hard.h"

namespace penumbra::studio {
namespace {

using ShadowWidthAgainstHardTest = AgainstHardTest;

TEST_F(ShadowWidthAgainstHardTest, IsNoWorseWhereGroundsCast) {
    expectNoWorseInBuiltinScenes("shadow-width");
}

/// A sun low above posts: 0.194 where `hard` has 0.053 with a map for the whole picture.
TEST_F(ShadowWidthAgainstHardTest, IsNoWorseInScenesOfTheField) {
    expectNoWorseInTheField(
        "shadow-width",
        {"room-0", "room-1mm", "room-bulb", "lowsun-e1", "lowsun-e5", "terminator-terminator", "cube-large",
         "lamp-shade", "city-triangle", "pillar-base", "pillar-yaw20", "mirror-mirror", "desk-ww",
         "ceiling-h27", "fixture-fixture", "pcss-wall-2.5", "window-open", "city-2"});
}

}  // namespace
}  // namespace penumbra::studio
