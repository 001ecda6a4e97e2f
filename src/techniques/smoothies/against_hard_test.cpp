// SPDX-License-Identifier: Apache-2.0
#include "tests/support/against_hard.h"
#include "studio/scene/builtin/builtin.h"
#include "studio/scene/open_scene.h"

namespace penumbra::studio {
namespace {

using SmoothiesAgainstHardTest = AgainstHardTest;

TEST_F(SmoothiesAgainstHardTest, IsNoWorseWhereGroundsCast) {
    for (const BuiltinInfo& info : builtinScenes())
        expectNoWorse("smoothies", makeBuiltin(info.name), info.name);
}

/// A sun low above posts: leaks of 1.7 % with a map for the whole picture.
TEST_F(SmoothiesAgainstHardTest, IsNoWorseInScenesOfTheField) {
    const std::optional<std::filesystem::path> field = fieldScenes();
    if (!field) GTEST_SKIP() << "no scenes of the field here";
    for (const char* name : {"room-0",           "room-1mm",      "room-bulb",
                             "lowsun-e1",        "lowsun-e5",     "terminator-terminator",
                             "cube-large",       "lamp-shade",    "city-triangle",
                             "pillar-base",      "pillar-yaw20",  "mirror-mirror",
                             "close-wallwasher", "desk-ww",       "ceiling-h27",
                             "fixture-fixture",  "pcss-wall-2.5", "window-open",
                             "lamp-bulb",        "ground-boxes"}) {
        expectNoWorse("smoothies", openScene((*field / name).string() + ".glb"), name);
    }
}

}  // namespace
}  // namespace penumbra::studio
