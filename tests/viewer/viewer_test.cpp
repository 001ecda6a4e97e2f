// SPDX-License-Identifier: Apache-2.0
// The window as a user works it: real events in, pictures and files out.
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>

#include "studio/image/image_io.h"
#include "tests/viewer/viewer_fixture.h"

namespace penumbra::studio::viewer {
namespace {

glm::vec3 eyeOf(const Session& session) {
    return glm::vec3(session.camera().worldFromCamera[3]);
}

glm::vec3 placeOfLight(const Session& session, std::size_t index = 0) {
    const Light& light = session.document().moment().lights.at(index);
    return glm::vec3(std::bit_cast<glm::mat4>(light.shape.worldFromLight)[3]);
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

TEST_F(ViewerTest, TheTruthConvergesAndJudges) {
    start("two-boxes");
    session().choices().referenceRuns = true;
    session().choices().referenceSamples = 64;
    session().changedView();
    framesUntil([&] { return session().truth() && session().truth()->samples == 64; });
    const auto& metrics = session().metrics(0);
    ASSERT_TRUE(metrics);
    EXPECT_GT(metrics->penumbra_rmse, 0.1) << "hard edges in a penumbra";
    // What is shown is what `compare` would say.
    const Side& side = session().side(0);
    const Image reach = readTexture(side.reach.name(), session().width_px(), session().height_px(), 1);
    std::vector<std::uint8_t> mask;
    for (const float value : reach.values) mask.push_back(value > 0);
    const VisibilityMetrics expected =
        compareVisibility(session().truth()->lights[0].visibility,
                          session().frame().readVisibility(side.visibilities[0]), mask);
    EXPECT_EQ(metrics->rmse, expected.rmse);
    EXPECT_LT(session().truth()->lights[0].noise_rms, 0.05);
    const auto level = session().truth();
    drag(0.3, 0.6, 0.4, 0.6);  // another view: what was true is not any more
    EXPECT_NE(session().truth(), level);
}

TEST_F(ViewerTest, WipeFlipAndDifference) {
    start("two-boxes");
    const Image hard = picture();
    key("shift+2");
    key("2");
    const Image pcf = picture();
    key("1");
    key("c");
    ASSERT_TRUE(session().choices().comparing);
    const int middle = session().canvasOptions().firstColumnOfB;
    EXPECT_NEAR(middle, session().width_px() / 2, 1);
    const auto isLeft = [&](const Image& shown, const Image& side, bool left) {
        for (int y = 0; y < shown.height_px; ++y) {
            for (int x = left ? 0 : middle; x < (left ? middle : shown.width_px); ++x) {
                if (shown.at(x, y) != side.at(x, y)) return false;
            }
        }
        return true;
    };
    EXPECT_TRUE(isLeft(canvas(), hard, true));
    EXPECT_TRUE(isLeft(canvas(), pcf, false));
    drag(0.5, 0.5, 0.25, 0.5);  // the line itself
    EXPECT_NEAR(session().choices().wipe, 0.25, 0.01);

    Display::input("keydown Tab");
    frames();
    EXPECT_EQ(largestDifference(canvas(), pcf), 0);
    Display::input("keyup Tab");
    key("c");
    EXPECT_EQ(largestDifference(canvas(), hard), 0);

    key("x");
    const Image difference = canvas();
    const Image a = session().frame().readVisibility(session().side(0).visibilities[0]);
    const Image b = session().frame().readVisibility(session().side(1).visibilities[0]);
    int lighter = 0, darker = 0;
    for (int y = 0; y < a.height_px; ++y) {
        for (int x = 0; x < a.width_px; ++x) {
            const float d = a.at(x, y) - b.at(x, y), red = difference.at(x, y, 0),
                        blue = difference.at(x, y, 2);
            if (d > 0.2f) lighter += red > blue + 0.2f;
            if (d < -0.2f) darker += blue > red + 0.2f;
            if (d == 0) {
                ASSERT_NEAR(red, blue, 0.12f) << x << " " << y;
            }
        }
    }
    EXPECT_GT(lighter, 20);
    EXPECT_GT(darker, 20);
    EXPECT_GT(shareOfDifferent(difference, hard), 0.1);
}

TEST_F(ViewerTest, FalseColoursAreTheNumbers) {
    start("half-plane", "exact");
    key("v");
    const Image shown = canvas();
    const Image visibility = session().frame().readVisibility(session().side(0).visibilities[0]);
    const Image reach = readTexture(session().side(0).reach.name(), shown.width_px, shown.height_px, 1);
    int checked = 0;
    for (int y = 0; y < shown.height_px; y += 5) {
        for (int x = 0; x < shown.width_px; x += 5) {
            if (reach.at(x, y) <= 0) continue;
            const auto color = orderedColor(std::round(visibility.at(x, y) * 255) / 255);
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(shown.at(x, y, c), color[std::size_t(c)], 1.1f / 255);
            ++checked;
        }
    }
    EXPECT_GT(checked, 100);
}

TEST_F(ViewerTest, IlluminanceIsInLux) {
    start("half-plane");
    // Nothing between the floor and a disk of 1,000 nits, radius 0.5 m, 4 m above: E = pi L r^2 / (r^2 +
    // h^2).
    Light disk = diskLight("disk", 0.5f, {0, 4, 0}, {0, 0, 0}, 1);
    disk.emission = {Emission::Unit::nits, glm::vec3(1000)};
    disk.castsShadow = false;
    session().editLights({disk});
    key("i");
    const Image lux =
        readTexture(session().side(0).illuminance.name(), session().width_px(), session().height_px(), 1);
    EXPECT_NEAR(std::ranges::max(lux.values), std::acos(-1.0) * 1000 * 0.25 / 16.25, 0.3);
    EXPECT_EQ(session().canvasOptions().range.max, 50);
    const Image withLines = canvas();
    clickWidget("isolines", 0.1);
    EXPECT_GT(shareOfDifferent(withLines, canvas()), 0.002);
    EXPECT_LT(shareOfDifferent(withLines, canvas()), 0.2);
}

TEST_F(ViewerTest, BuffersAreShown) {
    start("two-boxes");
    const std::vector<InspectedTexture> buffers = session().inspected();
    const auto depthMap = std::ranges::find(buffers, "depth map", &InspectedTexture::name);
    ASSERT_NE(depthMap, buffers.end());
    for (const InspectedTexture& buffer : buffers) {
        session().inspect(buffer, 0);
        const gl::Texture& shown = session().inspection().texture();
        const Image image = readTexture(shown.name(), shown.width_px(), shown.height_px(), 3);
        EXPECT_NE(std::ranges::min(image.values), std::ranges::max(image.values)) << buffer.name;
    }
}

TEST_F(ViewerTest, APickAsksEveryoneAndEveryBufferIsShown) {
    start("two-boxes");
    cheapen();
    // A pixel in the penumbra, found by the exact technique.
    chooseTechnique(session(), "exact");
    frames();
    const Image visibility = session().frame().readVisibility(session().side(0).visibilities[0]);
    const auto half = std::ranges::find_if(visibility.values, [](float v) { return v > 0.4f && v < 0.6f; });
    ASSERT_NE(half, visibility.values.end());
    const auto index = int(half - visibility.values.begin());
    const int x = index % visibility.width_px, y = index / visibility.width_px;
    click(to((x + 0.5) / visibility.width_px, (y + 0.5) / visibility.height_px));
    framesUntil([&] { return !session().picker().busy(); });
    const std::optional<Pick>& pick = session().picker().result();
    ASSERT_TRUE(pick);
    EXPECT_EQ(pick->x, x);
    EXPECT_EQ(pick->y, y);
    EXPECT_NEAR(*pick->truth, *half, 0.03);
    ASSERT_EQ(pick->answers.size(), techniqueCatalog().size());
    for (const Pick::Answer& answer : pick->answers) {
        if (answer.technique == "exact") {
            EXPECT_EQ(answer.visibility, *half);
        } else if (answer.technique == "hard") {
            EXPECT_TRUE(answer.visibility == 0 || answer.visibility == 1);
        }
    }
    EXPECT_GT(pick->illuminance_lux, 0);
    // The light, half of it behind something: bright and red pixels, about as many.
    const gl::Texture& view = session().picker().lightView();
    const Image seen = readTexture(view.name(), view.width_px(), view.height_px(), 3);
    int bright = 0, blocked = 0;
    for (std::size_t i = 0; i < seen.pixelCount(); ++i) {
        bright += seen.values[3 * i] > 0.95f;
        blocked += seen.values[3 * i] > 2 * seen.values[3 * i + 1] && seen.values[3 * i] > 0.15f;
    }
    ASSERT_GT(bright + blocked, 1000);
    // Solid angle against area, and pixels of a perspective: near for a light that is small from here.
    EXPECT_NEAR(double(bright) / (bright + blocked), *half, 0.1);
    key("Escape");
    EXPECT_FALSE(session().picker().result());

    // All techniques are there now: whatever they left behind can be looked at.
    for (const TechniqueInfo& info : techniqueCatalog()) {
        chooseTechnique(session(), std::string(info.name));
        frames(1);
        for (const InspectedTexture& buffer : session().inspected()) {
            session().inspect(buffer, buffer.layers - 1);
        }
        EXPECT_EQ(session().problem(), "") << info.name;
    }
}

}  // namespace
}  // namespace penumbra::studio::viewer
