// SPDX-License-Identifier: Apache-2.0
// The window as a user works it: real events in, pictures and files out.

#include <algorithm>

#include "studio/image/image_io.h"
#include "tests/viewer/viewer_fixture.h"

namespace penumbra::studio::viewer {
namespace {

glm::vec3 eyeOf(const Session& session) {
    return glm::vec3(session.camera().worldFromCamera[3]);
}

TEST_F(ViewerTest, StartsWithAPictureAndThreeLinesOfHelp) {
    viewer_ = std::make_unique<Viewer>(options(""));
    frames(2);
    EXPECT_TRUE(viewer().windowState().showsWelcome);
    EXPECT_EQ(session().document().nameOrPath(), "primitives");
    // A shadow that is soft: there are values between lit and dark.
    const Image visibility = session().frame().readVisibility(session().side(0).visibilities.at(0));
    const auto soft = std::ranges::count_if(visibility.values, [](float v) { return v > 0.1f && v < 0.9f; });
    EXPECT_GT(soft, std::ptrdiff_t(visibility.values.size()) / 50);
    const Image window = viewer().screenshot();
    EXPECT_GT(std::ranges::max(window.values), 0.9f);
    click(to(0.5, 0.5));
    EXPECT_FALSE(viewer().windowState().showsWelcome);
}

TEST_F(ViewerTest, MouseAndKeysMoveTheCamera) {
    start("two-boxes");
    const glm::vec3 eye = eyeOf(session());
    const Image before = picture();
    drag(0.3, 0.6, 0.6, 0.6);  // left: around the middle
    EXPECT_GT(glm::distance(eyeOf(session()), eye), 0.5f);
    EXPECT_NEAR(eyeOf(session()).y, eye.y, 1e-3f);
    EXPECT_GT(shareOfDifferent(before, picture()), 0.05);

    const auto distance = [&] {
        const LookAt look = session().cameraControl().lookAt();
        return glm::distance(look.eye, look.target);
    };
    const float far = distance();
    Display::input("click 4 click 4");  // the wheel
    frames();
    EXPECT_NEAR(distance(), far * 0.88f * 0.88f, 1e-3f * far);

    const glm::vec3 target = session().cameraControl().lookAt().target;
    drag(0.5, 0.5, 0.7, 0.5, 2);
    EXPECT_GT(glm::distance(session().cameraControl().lookAt().target, target), 0.1f);

    const glm::vec3 here = eyeOf(session());
    Display::input(to(0.5, 0.5) + " mousedown 3 keydown w");
    frames(6);
    Display::input("keyup w mouseup 3");
    frames();
    EXPECT_GT(glm::distance(eyeOf(session()), here), 0.01f);

    key("f");
    EXPECT_NEAR(
        glm::distance(session().cameraControl().lookAt().target, session().document().bounds().center()), 0,
        1e-4f);
    key("r");
    EXPECT_EQ(eyeOf(session()), eye);
    EXPECT_EQ(largestDifference(before, picture()), 0);
}

TEST_F(ViewerTest, KeysChooseTechniques) {
    start("two-boxes");
    const Image hard = picture();
    key("3");
    EXPECT_EQ(session().choices().technique, techniqueChoices()[2]);
    EXPECT_GT(shareOfDifferent(hard, picture()), 0.001);
    key("shift+2");
    EXPECT_EQ(session().choices().other, techniqueChoices()[1]);
    key("0");
    EXPECT_EQ(session().choices().technique, "reference");
    key("1");
    EXPECT_EQ(largestDifference(hard, picture()), 0);
    key("question");
    EXPECT_TRUE(viewer().windowState().showsHelp);
    clickWidget("Close help");
    EXPECT_FALSE(viewer().windowState().showsHelp);
}

TEST_F(ViewerTest, StartsAsTheCommandAsks) {
    ViewerOptions asked = options("moving");
    asked.technique = "pcf";
    asked.parameters = {{"map_size", "64"}};
    asked.time_s = 0.5;
    asked.camera = [](const Scene&, const SceneMoment&) {
        return lookAtCamera({.eye = {1, 2, 3}, .target = {0, 0.5f, 0}});
    };
    viewer_ = std::make_unique<Viewer>(asked);
    frames();
    EXPECT_EQ(session().choices().technique, "pcf");
    EXPECT_EQ(session().techniques().changes("pcf"), asked.parameters);
    EXPECT_EQ(session().document().time_s(), 0.5);
    EXPECT_NEAR(glm::distance(eyeOf(session()), {1, 2, 3}), 0, 1e-5f);
    key("ctrl+z");  // how it began is no step
    EXPECT_EQ(session().choices().technique, "pcf");
}

TEST_F(ViewerTest, ExposureIsHeld) {
    start("two-boxes");
    const Image before = picture();
    clickWidget("automatic exposure", 0.1);
    ASSERT_TRUE(session().choices().exposureValue);
    EXPECT_LE(largestDifference(before, picture()), 1.01 / 255);
    std::vector<Light> lights = session().document().moment().lights;
    for (Light& light : lights) light.emission.value *= 0.25f;
    session().editLights(lights);
    frames();
    EXPECT_GT(largestDifference(before, picture()), 0.2) << "a lamp of a quarter is darker";
    clickWidget("automatic exposure", 0.1);
    EXPECT_FALSE(session().choices().exposureValue);
    // The light's rotation went through a quaternion: a pixel of the hard edge may differ.
    EXPECT_LE(shareOfDifferent(before, picture(), 2.01 / 255), 0.005);
}

TEST_F(ViewerTest, ParametersHaveWidgetsAndAWayBack) {
    start("two-boxes", "pcf");
    const Image before = picture();
    clickWidget("map size (texels)##map_size", 0.2);
    ASSERT_EQ(session().techniques().changes("pcf").size(), 1u);
    EXPECT_GT(largestDifference(before, picture()), 0);
    clickWidget("x##reset map_size");
    EXPECT_TRUE(session().techniques().changes("pcf").empty());
    EXPECT_EQ(largestDifference(before, picture()), 0);
}

TEST_F(ViewerTest, PresetsAreKept) {
    start("two-boxes", "pcf");
    clickWidget("radius (texels)##radius", 0.4);
    const ParameterValues changed = session().techniques().changes("pcf");
    clickWidget("##preset name");
    Display::input("type wide");
    frames();
    clickWidget("Keep as preset");
    clickWidget("preset", 0.3);
    clickWidget("(the defaults)");
    EXPECT_TRUE(session().techniques().changes("pcf").empty());
    clickWidget("preset", 0.3);
    clickWidget("wide");
    EXPECT_EQ(session().techniques().changes("pcf"), changed);
}

}  // namespace
}  // namespace penumbra::studio::viewer
