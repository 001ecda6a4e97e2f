// SPDX-License-Identifier: Apache-2.0
// Lights by hand in the window, and what was done undone.

#include <GLFW/glfw3.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "studio/image/atomic_file.h"
#include "studio/image/image_io.h"
#include "studio/scene/builtin/placing.h"
#include "studio/viewer/candela_web.h"
#include "tests/viewer/viewer_fixture.h"

namespace penumbra::studio::viewer {
namespace {

glm::vec3 placeOfLight(const Session& session, std::size_t index = 0) {
    const Light& light = session.document().moment().lights.at(index);
    return glm::vec3(std::bit_cast<glm::mat4>(light.shape.worldFromLight)[3]);
}

/// A file dropped onto the window.
void drop(Viewer& viewer, const std::string& file) {
    const char* path = file.c_str();
    GLFWwindow* window = viewer.window().handle();
    const GLFWdropfun callback = glfwSetDropCallback(window, nullptr);
    glfwSetDropCallback(window, callback);
    callback(window, 1, &path);
}

TEST_F(ViewerTest, LightsAreAddedEditedAndSaved) {
    start(writeScene("box.gltf"));
    const std::size_t before = session().document().moment().lights.size();
    const Image first = picture();
    clickWidget("Add");
    ASSERT_EQ(session().document().moment().lights.size(), before + 1);
    EXPECT_GT(shareOfDifferent(first, picture()), 0.001);
    clickWidget("Duplicate");
    EXPECT_EQ(session().document().moment().lights.size(), before + 2);
    clickWidget("Delete");
    EXPECT_EQ(session().document().moment().lights.size(), before + 1);
    clickWidget("casts shadow", 0.1);
    EXPECT_FALSE(session().document().moment().lights[session().choices().light].castsShadow);
    const Image edited = picture();

    key("ctrl+s");
    EXPECT_TRUE(std::filesystem::exists(at("box.lights.json"))) << viewer().windowState().message;
    EXPECT_FALSE(session().document().lights().unsaved());
    viewer_.reset();
    start(at("box.gltf"));
    EXPECT_EQ(session().document().moment().lights.size(), before + 1);
    EXPECT_EQ(largestDifference(edited, picture()), 0);
}

TEST_F(ViewerTest, WhatWasDoneIsUndoneAndRedone) {
    start(writeScene("box.gltf"), "pcf");
    const std::size_t before = session().document().moment().lights.size();
    const Image first = picture();
    clickWidget("Add");
    clickWidget("casts shadow", 0.1);
    clickWidget("map size (texels)##map_size", 0.2);
    Display::input(to(0.5, 0.5));
    key("1");
    const Work done = session().work();
    const Image last = picture();

    key("ctrl+z");
    EXPECT_EQ(session().choices().technique, "pcf");
    key("ctrl+z");
    EXPECT_TRUE(session().techniques().changes("pcf").empty());
    key("ctrl+z");
    EXPECT_TRUE(session().document().moment().lights.back().castsShadow);
    key("ctrl+z");
    EXPECT_EQ(session().document().moment().lights.size(), before);
    EXPECT_FALSE(session().document().lights().unsaved());
    EXPECT_EQ(largestDifference(first, picture()), 0);
    key("ctrl+z");  // nothing is left
    for (int step = 0; step < 4; ++step) key("ctrl+shift+z");
    EXPECT_EQ(session().work(), done);
    EXPECT_EQ(largestDifference(last, picture()), 0);
}

TEST_F(ViewerTest, ADragIsOneStep) {
    start("two-boxes");
    const std::vector<Light> before = session().document().moment().lights;
    clickWidget("Duplicate");
    const Work doubled = session().work();
    ASSERT_NE(widget("width (m)"), nullptr);
    const PlacedWidget size = *widget("width (m)");
    const float y = 0.5f * (size.min.y + size.max.y);
    const auto place = [&](double share) {
        return "mousemove " + std::to_string(int(size.min.x + share * (size.max.x - size.min.x))) + " " +
               std::to_string(int(y));
    };
    Display::input(place(0.3) + " mousedown 1");
    frames();
    for (const double share : {0.4, 0.5, 0.6}) {
        Display::input(place(share));
        frames();
    }
    Display::input("mouseup 1");
    frames();
    ASSERT_NE(session().work(), doubled);
    key("ctrl+z");
    EXPECT_EQ(session().work(), doubled);
}

TEST_F(ViewerTest, LeavingUnsavedLightsAsks) {
    start(writeScene("box.gltf"));
    clickWidget("Add");
    const std::size_t count = session().document().moment().lights.size();
    key("ctrl+q");
    ASSERT_TRUE(viewer().windowState().leaving);
    clickWidget("Stay");
    EXPECT_FALSE(viewer().windowState().leaving);
    EXPECT_EQ(session().document().moment().lights.size(), count);
    ASSERT_TRUE(viewer().frame(false));

    const std::string other = writeScene("other.gltf");
    const char* paths[] = {other.c_str()};
    GLFWwindow* window = viewer().window().handle();
    const GLFWdropfun drop = glfwSetDropCallback(window, nullptr);
    glfwSetDropCallback(window, drop);
    drop(window, 1, paths);
    frames();
    ASSERT_TRUE(viewer().windowState().leaving);
    EXPECT_EQ(session().document().nameOrPath(), at("box.gltf"));
    clickWidget("Save lights and go on");
    EXPECT_TRUE(std::filesystem::exists(at("box.lights.json")));
    EXPECT_EQ(session().document().nameOrPath(), other);

    clickWidget("Add");
    paths[0] = "two-boxes";
    drop(window, 1, paths);
    frames();
    clickWidget("Drop the changes");
    EXPECT_EQ(session().document().nameOrPath(), "two-boxes");
    EXPECT_FALSE(std::filesystem::exists(at("other.lights.json")));
}

TEST_F(ViewerTest, LightsMoveTurnAndGrowByHand) {
    start("two-boxes");
    const CanvasPlace& place = viewer().canvasPlace();
    // Takes hold of the handle's last point and moves it by a tenth of the canvas.
    const auto pull = [&](Gizmo::Axis axis) {
        const Projection projection(session().cameraView(), {place.size.x, place.size.y});
        const auto handles =
            Gizmo::handles(session().document().moment().lights.at(0), viewer().windowState().gizmoMode,
                           projection, session().document().bounds(), 1);
        const auto handle = std::ranges::find(handles, axis, &Gizmo::Handle::axis);
        ASSERT_NE(handle, handles.end());
        const glm::vec2 at = handle->line_px.back() / glm::vec2(place.size.x, place.size.y);
        ASSERT_TRUE(at.x > 0 && at.x < 1 && at.y > 0 && at.y < 1) << "the light must be in the picture";
        const glm::vec2 along = glm::normalize(handle->line_px.back() - handle->line_px.front());
        drag(at.x, at.y, at.x + 0.1 * along.x, at.y + 0.1 * along.y);
    };
    session().editLights({rectLight("key", 1, 0.5f, {0.4f, 1.6f, 0.5f}, {0, 0, 0}, 700)});
    session().freeCamera().frame({{-2, -1, -2}, {2, 3, 2}}, 0.5f);
    session().changedView();
    frames();
    const Image before = picture();
    const glm::vec3 from = placeOfLight(session());
    pull(Gizmo::Axis::x);
    EXPECT_GT(placeOfLight(session()).x, from.x + 0.05f);
    EXPECT_NEAR(placeOfLight(session()).y, from.y, 1e-4f);
    EXPECT_GT(shareOfDifferent(before, picture()), 0.01);

    key("s");
    const float width_m = session().document().moment().lights[0].shape.width_m;
    pull(Gizmo::Axis::x);
    EXPECT_GT(session().document().moment().lights[0].shape.width_m, width_m + 0.05f);

    key("t");
    const Mat4 direction = session().document().moment().lights[0].shape.worldFromLight;
    const Projection projection(session().cameraView(), {place.size.x, place.size.y});
    const auto rings = Gizmo::handles(session().document().moment().lights.at(0), Gizmo::Mode::turn,
                                      projection, session().document().bounds(), 1);
    const glm::vec2 size(place.size.x, place.size.y);
    const glm::vec2 a = rings.at(0).line_px.at(2) / size, b = rings.at(0).line_px.at(12) / size;
    drag(a.x, a.y, b.x, b.y);
    EXPECT_NE(session().document().moment().lights[0].shape.worldFromLight, direction);
}

TEST_F(ViewerTest, TubesAreEditedByHand) {
    start("two-boxes");
    session().editLights({rectLight("key", 1, 0.5f, {0.4f, 1.6f, 0.5f}, {0, 0, 0}, 700)});
    session().freeCamera().frame({{-2, -1, -2}, {2, 3, 2}}, 0.5f);
    session().changedView();
    frames();
    const Work before = session().work();
    const auto light = [&]() -> const Light& { return session().document().moment().lights.at(0); };
    clickWidget("shape", 0.3);
    clickWidget("tube");
    ASSERT_EQ(light().shape.shape, LightShape::cylinder);
    EXPECT_GT(light().shape.length_m, 10 * light().shape.radius_m);
    ASSERT_NE(widget("length (m)"), nullptr);

    key("s");
    const CanvasPlace& place = viewer().canvasPlace();
    const glm::vec2 size(place.size.x, place.size.y);
    for (const auto& [axis, extent] :
         {std::pair{Gizmo::Axis::x, &AreaLight::length_m}, std::pair{Gizmo::Axis::y, &AreaLight::radius_m}}) {
        const Projection projection(session().cameraView(), size);
        const auto handles =
            Gizmo::handles(light(), Gizmo::Mode::resize, projection, session().document().bounds(), 1);
        const auto handle = std::ranges::find(handles, axis, &Gizmo::Handle::axis);
        ASSERT_NE(handle, handles.end());
        const glm::vec2 end = handle->line_px.back() / size;
        const glm::vec2 along = glm::normalize(handle->line_px.back() - handle->line_px.front());
        const float was = light().shape.*extent;
        drag(end.x, end.y, end.x + 0.1 * along.x, end.y + 0.1 * along.y);
        EXPECT_GT(light().shape.*extent, was + 0.05f) << int(axis);
    }
    const Work done = session().work();
    const Image last = picture();
    for (int step = 0; step < 3; ++step) key("ctrl+z");
    EXPECT_EQ(session().work(), before);
    for (int step = 0; step < 3; ++step) key("ctrl+shift+z");
    EXPECT_EQ(session().work(), done);
    EXPECT_EQ(largestDifference(last, picture()), 0);
}

TEST_F(ViewerTest, TheSunStandsWhereAndWhenItIsAsked) {
    start(writeScene("box.gltf"));
    session().editLights({distantLight("sun", 0.01f, {0, -1, 0.2f}, 1000)});
    frames();
    const auto light = [&]() -> const Light& { return session().document().moment().lights.at(0); };
    ASSERT_FALSE(light().sun);
    const Work before = session().work();
    clickWidget("the sun of a place and time", 0.05);
    ASSERT_TRUE(light().sun);
    EXPECT_EQ(widget("angle (deg)"), nullptr) << "the sun is as large as it is";
    const std::string noon = light().sun->time;
    const Mat4 atNoon = light().shape.worldFromLight;
    const Image first = picture();

    const float hourWidth = 150;  // of the slider in the widget, which its label is part of
    const auto clickSlider = [&](const std::string& label, double share) {
        const PlacedWidget* placed = widget(label);
        ASSERT_NE(placed, nullptr) << label;
        clickWidget(label, share * double(hourWidth) / double(placed->max.x - placed->min.x));
    };
    clickSlider("hour", 0.75);
    EXPECT_NE(light().sun->time, noon);
    EXPECT_TRUE(light().sun->time.starts_with("2026-06-21T1")) << light().sun->time;
    EXPECT_NE(light().shape.worldFromLight, atNoon);
    EXPECT_GT(shareOfDifferent(first, picture()), 0.001);
    const std::string evening = light().sun->time;
    clickSlider("hour", 0.02);  // at night it stays where it was
    EXPECT_EQ(light().sun->time, evening);
    EXPECT_NE(viewer().windowState().message.find("below the horizon"), std::string::npos)
        << viewer().windowState().message;
    clickSlider("latitude (deg)", 0.5);
    EXPECT_LT(std::abs(light().sun->latitude_deg), 10);
    clickSlider("north (deg from -Z)", 0.75);
    EXPECT_GT(light().sun->setting.north_deg, 45);
    const Image last = picture();

    key("ctrl+s");
    viewer_.reset();
    start(at("box.gltf"));
    ASSERT_TRUE(light().sun);
    EXPECT_EQ(light().sun->time, evening);
    EXPECT_EQ(largestDifference(last, picture()), 0);
    viewer_.reset();

    start(at("box.gltf"));
    const Work saved = session().work();
    clickSlider("hour", 0.6);
    EXPECT_NE(session().work(), saved);
    key("ctrl+z");
    EXPECT_EQ(session().work(), saved);
    EXPECT_EQ(light().sun->time, evening);
    clickWidget("the sun of a place and time", 0.05);  // what it was is kept as a distant light
    EXPECT_FALSE(light().sun);
    EXPECT_EQ(light().shape.shape, LightShape::distant);
}

TEST_F(ViewerTest, AMakersFileMakesALightThatLuminaireWhereItIs) {
    start(writeScene("box.gltf"));
    session().editLights({rectLight("lamp", 0.2f, 0.2f, {0.1f, 1.5f, 0.2f}, {0.1f, 0, 0.2f}, 100)});
    frames();
    const Work before = session().work();
    const std::string file = at("tube.ies");
    writeFileAtomically(file,
                        "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 1.2 -0.04 -0.04\n1 1 10\n0 90 180\n0\n"
                        "500 300 20\n");
    drop(viewer(), file);
    frames();
    const auto light = [&]() -> const Light& { return session().document().moment().lights.at(0); };
    ASSERT_TRUE(light().profile) << viewer().windowState().message;
    EXPECT_EQ(light().shape.shape, LightShape::cylinder);
    EXPECT_NEAR(placeOfLight(session()).y, 1.5f, 1e-6);
    const Mat4 frame = light().shape.worldFromLight;

    // Its web, shown about its place: 500 cd downwards is the longest, and goes as far as a web does.
    const auto web = candelaWeb(light(), session().document().bounds());
    ASSERT_FALSE(web.empty());
    float lowest = 1e9f, highest = -1e9f;
    for (const auto& line : web) {
        for (const glm::vec3& point : line) {
            lowest = std::min(lowest, point.y - 1.5f);
            highest = std::max(highest, point.y - 1.5f);
        }
    }
    const float reach_m = session().document().bounds().radius() / 7;
    EXPECT_NEAR(lowest, -reach_m, 1e-3f * reach_m);
    // From 300 cd at 90 degrees to 20 cd at 180, along a line.
    float upwards_cd = 0;
    for (float above_deg = 0; above_deg <= 90; ++above_deg)
        upwards_cd = std::max(upwards_cd, (300 - 280 * above_deg / 90) * std::sin(glm::radians(above_deg)));
    EXPECT_NEAR(highest, upwards_cd / 500 * reach_m, 0.02f * reach_m);

    const Work loaded = session().work();
    key("ctrl+z");
    EXPECT_EQ(session().work(), before);
    EXPECT_FALSE(light().profile);
    key("ctrl+shift+z");
    EXPECT_EQ(session().work(), loaded);
    ASSERT_TRUE(light().profile);

    clickWidget("x (m)", 0.2);  // what is clicked and not pulled stays
    clickWidget("casts shadow", 0.1);
    EXPECT_EQ(light().shape.worldFromLight, frame) << "no edit turns it once more";
    key("ctrl+s");
    const Image last = picture();
    viewer_.reset();
    start(at("box.gltf"));
    EXPECT_EQ(light().shape.shape, LightShape::cylinder);
    EXPECT_EQ(largestDifference(last, picture()), 0);

    writeFileAtomically(file, "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3");
    viewer_.reset();
    start(at("box.gltf"));
    const Work saved = session().work();
    drop(viewer(), file);
    frames();
    EXPECT_EQ(session().work(), saved) << "a file that cannot be read changes nothing";
    EXPECT_TRUE(viewer().windowState().messageIsError);
    EXPECT_NE(viewer().windowState().message.find("tube.ies:"), std::string::npos)
        << viewer().windowState().message;
}

TEST_F(ViewerTest, ADistantLightIsMadeNoLuminaire) {
    start(writeScene("box.gltf"));
    session().editLights({rectLight("lamp", 0.2f, 0.2f, {0.1f, 1.5f, 0.2f}, {0.1f, 0, 0.2f}, 100)});
    frames();
    EXPECT_TRUE(widget("Load a luminaire ..."));
    session().editLights({distantLight("sun", 0.01f, {0, -1, 0}, 1)});
    frames();
    EXPECT_FALSE(widget("Load a luminaire ..."));

    const Work before = session().work();
    const std::string file = at("lamp.ies");
    writeFileAtomically(file,
                        "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 10\n0 180\n0\n100 100\n");
    drop(viewer(), file);
    frames();
    EXPECT_EQ(session().work(), before);
    EXPECT_TRUE(viewer().windowState().messageIsError);
    EXPECT_NE(viewer().windowState().message.find("'sun' is a distant light"), std::string::npos)
        << viewer().windowState().message;
}

}  // namespace
}  // namespace penumbra::studio::viewer
