// SPDX-License-Identifier: Apache-2.0
// The window as a user works it: real events in, pictures and files out.
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>

#include "studio/image/image_io.h"
#include "studio/viewer/smoke.h"
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
    EXPECT_TRUE(viewer().desk().showsWelcome);
    EXPECT_EQ(session().document().nameOrPath(), "primitives");
    // A shadow that is soft: there are values between lit and dark.
    const Image visibility = session().frame().readVisibility(session().side(0).visibilities.at(0));
    const auto soft = std::ranges::count_if(visibility.values, [](float v) { return v > 0.1f && v < 0.9f; });
    EXPECT_GT(soft, std::ptrdiff_t(visibility.values.size()) / 50);
    const Image window = viewer().screenshot();
    EXPECT_GT(std::ranges::max(window.values), 0.9f);
    click(to(0.5, 0.5));
    EXPECT_FALSE(viewer().desk().showsWelcome);
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
    EXPECT_TRUE(viewer().desk().showsHelp);
    clickWidget("Close help");
    EXPECT_FALSE(viewer().desk().showsHelp);
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
    EXPECT_TRUE(std::filesystem::exists(at("box.lights.json"))) << viewer().desk().message;
    EXPECT_FALSE(session().document().lights().unsaved());
    viewer_.reset();
    start(at("box.gltf"));
    EXPECT_EQ(session().document().moment().lights.size(), before + 1);
    EXPECT_EQ(largestDifference(edited, picture()), 0);
}

TEST_F(ViewerTest, LightsMoveTurnAndGrowByHand) {
    start("two-boxes");
    const CanvasPlace& place = viewer().canvasPlace();
    // Takes hold of the handle's last point and moves it by a tenth of the canvas.
    const auto pull = [&](Gizmo::Axis axis) {
        const Projection projection(session().cameraView(), {place.size.x, place.size.y});
        const auto handles =
            Gizmo::handles(session().document().moment().lights.at(0), viewer().desk().gizmoMode, projection,
                           session().document().bounds(), 1);
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

TEST_F(ViewerTest, TheCopiedCommandMakesTheSamePixels) {
    start("many-lights");
    const auto expectSamePixels = [&](const std::string& what) {
        frames(2);
        key("ctrl+c");
        const std::string line = viewer().window().clipboard();
        ASSERT_TRUE(line.starts_with("penumbra render ")) << line;
        ASSERT_EQ(run(line), 0) << what << ": " << line;
        EXPECT_TRUE(samePixels(readPng(at("picture.png")).image, picture())) << what << ": " << line;
    };
    expectSamePixels("as opened");
    drag(0.3, 0.6, 0.55, 0.5);
    expectSamePixels("another camera");
    std::vector<Light> lights = session().document().moment().lights;
    lights.resize(2);
    lights[0].name = "it's \"edited\" = so";
    lights[0].shape.width_m = 0.3f;
    lights[1].emission.value = {100.7f, 33.3f, 3.1f};
    session().editLights(lights);
    session().choices().techniqueOfLight[lights[0].name] = "pcf";
    setParameter(session().techniques().get("pcf"), "radius", "3.7");
    setParameter(session().techniques().get("hard"), "map_size", "512");
    session().changedLighting();
    expectSamePixels("edited lights, a technique for one of them, parameters");
}

TEST_F(ViewerTest, TheCopiedCommandKnowsTimeTextureAndReference) {
    start("moving");
    session().setTime(1.3);
    const auto expectSamePixels = [&] {
        frames(2);
        key("ctrl+c");
        const std::string line = viewer().window().clipboard();
        ASSERT_EQ(run(line), 0) << line;
        EXPECT_TRUE(samePixels(readPng(at("picture.png")).image, picture())) << line;
    };
    expectSamePixels();
    session().open("textured-window");
    session().editLights(session().document().moment().lights);
    expectSamePixels();
    session().choices().referenceSamples = 16;
    key("0");
    framesUntil([&] { return session().truth() && session().truth()->samples == 16; });
    expectSamePixels();
}

TEST_F(ViewerTest, PicturesCarryWhatMadeThem) {
    start("two-boxes");
    key("F2");
    ASSERT_TRUE(std::filesystem::exists(at("two-boxes.001.png"))) << viewer().desk().message;
    const PngPicture saved = readPng(at("two-boxes.001.png"));
    EXPECT_TRUE(samePixels(saved.image, picture()));
    EXPECT_TRUE(saved.metadata.at("penumbra:command").starts_with("penumbra render two-boxes"));
    const ExrPicture exr = readExr(at("two-boxes.001.exr"));
    EXPECT_EQ(exr.metadata.at("penumbra:command"), saved.metadata.at("penumbra:command"));
    EXPECT_EQ(exr.channels.size(), 4u);  // radiance and illuminance
    key("v");
    key("F3");
    const PngPicture shown = readPng(at("two-boxes.002.png"));
    EXPECT_TRUE(samePixels(shown.image, canvas()));
    EXPECT_EQ(shown.metadata.at("penumbra:shown"), "visibility");
}

TEST_F(ViewerTest, SettingsSurviveARestart) {
    start("two-boxes");
    key("2");
    setParameter(session().techniques().get("pcf"), "radius", "3.5");
    session().choices().resolutionScale = 0.5f;
    viewer_.reset();
    viewer_ = std::make_unique<Viewer>(options("two-boxes"));
    frames();
    EXPECT_EQ(session().choices().technique, "pcf");
    EXPECT_EQ(session().techniques().changes("pcf"), (ParameterValues{{"radius", "3.5"}}));
    EXPECT_EQ(session().choices().resolutionScale, 0.5f);
    EXPECT_EQ(viewer().window().width_px(), 900);
    EXPECT_EQ(viewer().settings().recentFiles.front(), "two-boxes");
}

TEST_F(ViewerTest, AnimationPlaysPausesAndIsRecorded) {
    start("moving");
    key("space");
    EXPECT_TRUE(viewer().desk().playing);
    frames(4);
    EXPECT_GT(session().document().time_s(), 0);
    key("space");
    const double paused_s = session().document().time_s();
    frames();
    EXPECT_EQ(session().document().time_s(), paused_s);
    key("period");
    EXPECT_GT(session().document().time_s(), paused_s);
    clickWidget("##time", 0.5);
    EXPECT_NEAR(session().document().time_s(), 2, 0.2);

    viewer().desk().recording = {at("frames"), 3, 5, 24};
    clickWidget("Record");
    framesUntil([&] { return !viewer().recorder().active(); });
    ASSERT_TRUE(std::filesystem::exists(at("frames/frame.0005.png"))) << viewer().desk().message;
    EXPECT_FALSE(std::filesystem::exists(at("frames/frame.0006.png")));
    const PngPicture last = readPng(at("frames/frame.0005.png"));
    EXPECT_GT(shareOfDifferent(readPng(at("frames/frame.0003.png")).image, last.image), 0.001);
    ASSERT_EQ(run(last.metadata.at("penumbra:command")), 0);
    EXPECT_EQ(largestDifference(readPng(at("picture.png")).image, last.image), 0);
}

TEST_F(ViewerTest, WrongFilesLeaveTheSceneStanding) {
    start("two-boxes");
    const Image before = picture();
    std::ofstream(at("broken.gltf")) << "{ no scene";
    key("ctrl+o");
    Display::input("type " + at("broken.gltf"));
    frames();
    key("Return");
    EXPECT_TRUE(viewer().desk().messageIsError);
    EXPECT_NE(viewer().desk().message.find("broken.gltf"), std::string::npos);
    EXPECT_EQ(session().document().nameOrPath(), "two-boxes");
    EXPECT_EQ(largestDifference(before, picture()), 0);

    // Dropped: what the window system would call.
    const std::string missing = at("missing.glb");
    const char* paths[] = {missing.c_str()};
    GLFWwindow* window = viewer().window().handle();
    const GLFWdropfun drop = glfwSetDropCallback(window, nullptr);
    glfwSetDropCallback(window, drop);
    drop(window, 1, paths);
    frames();
    EXPECT_NE(viewer().desk().message.find("missing.glb"), std::string::npos);
    EXPECT_EQ(session().document().nameOrPath(), "two-boxes");
    const std::string good = writeScene("good.gltf");
    paths[0] = good.c_str();
    drop(window, 1, paths);
    frames();
    EXPECT_EQ(session().document().nameOrPath(), good);
    EXPECT_GT(shareOfDifferent(before, picture()), 0.05);
}

TEST_F(ViewerTest, MenusOpenScenes) {
    start("two-boxes");
    clickWidget("File");
    clickWidget("Built-in scenes");
    clickWidget("torus");
    EXPECT_EQ(session().document().nameOrPath(), "torus");
}

TEST_F(ViewerTest, ShadersAreReadAgainAndTheLastGoodOnesKept) {
    namespace fs = std::filesystem;
    const fs::path source = PENUMBRA_SOURCE_DIRECTORY;
    for (const char* root : {"src", "studio"}) {
        for (const auto& entry : fs::recursive_directory_iterator(source / root)) {
            const std::string name = entry.path().filename();
            if (!name.ends_with(".glsl") && !name.ends_with("_io.h")) continue;
            const fs::path copy = folder_.path() / fs::relative(entry.path(), source);
            fs::create_directories(copy.parent_path());
            fs::copy_file(entry.path(), copy);
        }
    }
    saveSettings(
        {.width = 900, .height = 600, .resolutionScale = 0.5f, .referenceRuns = false, .technique = "hard"},
        at("viewer.json"));
    ViewerOptions watched = options("two-boxes");
    watched.shaderSourceDirectory = folder_.path();
    viewer_ = std::make_unique<Viewer>(watched);
    frames();
    const Image before = picture();
    const fs::path shader = folder_.path() / "studio/frame/tone_map.comp.glsl";
    std::ostringstream text;
    text << std::ifstream(shader).rdbuf();
    const std::string good = text.str();

    driverMayComplain_ = true;
    std::ofstream(shader) << good << "\nthis is no GLSL\n";
    framesUntil([&] { return !session().shaderProblem().empty(); });
    EXPECT_NE(session().shaderProblem().find("tone_map.comp.glsl"), std::string::npos);
    frames();
    EXPECT_EQ(largestDifference(before, picture()), 0);

    std::string changed = good;
    const std::string fill = "const float fill = 0.06;";
    changed.replace(changed.find(fill), fill.size(), "const float fill = 0.5; ");
    std::ofstream(shader) << changed;
    framesUntil([&] { return session().shaderProblem().empty(); });
    frames();
    EXPECT_GT(shareOfDifferent(before, picture()), 0.3);
}

int liveTextures() {
    int count = 0;
    for (GLuint name = 1; name < 20000; ++name) count += glIsTexture(name) == GL_TRUE;
    return count;
}

long residentPages() {
    long total = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> total >> resident;
    return resident;
}

TEST_F(ViewerTest, NothingLeaksOverAThousandFrames) {
    saveSettings(
        {.width = 480, .height = 320, .resolutionScale = 0.25f, .referenceRuns = false, .technique = "hard"},
        at("viewer.json"));
    viewer_ = std::make_unique<Viewer>(options("two-boxes"));
    frames();
    key("F1");  // without the panel, whose drawing would take most of the time
    ASSERT_FALSE(viewer().desk().showsPanel);
    const auto turn = [&](int count) {
        for (int i = 0; i < count; ++i) {
            session().freeCamera().orbit(0.01f, 0);
            session().changedView();
            frames(1);
        }
    };
    turn(100);
    const int textures = liveTextures();
    const long pages = residentPages();
    turn(1000);
    EXPECT_EQ(liveTextures(), textures);
    // 8 MiB: the allocator's own coming and going; 9 KiB a frame would show.
    EXPECT_LT(residentPages() - pages, 8 * 256);
}

TEST_F(ViewerTest, AnySizeIsShown) {
    start("two-boxes");
    for (const auto& [width, height] : {std::pair{1, 1}, {37, 900}, {1600, 1200}, {900, 600}}) {
        viewer().window().setSize(width, height);
        framesUntil(
            [&] { return viewer().window().width_px() == width && viewer().window().height_px() == height; });
        frames(1);
        EXPECT_EQ(session().problem(), "");
        const Image window = viewer().screenshot();
        EXPECT_EQ(window.width_px, width);
        EXPECT_EQ(window.height_px, height);
    }
}

TEST(ViewerDisplay, ThingsAreLargerOnFineDisplays) {
    float heights[2];
    for (const int dpi : {96, 192}) {
        const Display display(dpi);
        const TestFolder folder;
        saveSettings({.width = 400, .height = 300, .referenceRuns = false, .technique = "hard"},
                     folder / "viewer.json");
        Viewer viewer({.scene = "two-boxes", .settings = folder / "viewer.json", .data = folder.path()});
        viewer.session().choices().resolutionScale = 0.25f;
        viewer.frame(false);
        viewer.frame(false);
        const auto& widgets = viewer.widgets();
        const auto add = std::ranges::find(widgets, "Add", &PlacedWidget::label);
        ASSERT_NE(add, widgets.end());
        heights[dpi / 192] = add->max.y - add->min.y;
    }
    EXPECT_NEAR(heights[1] / heights[0], 2, 0.1);
}

TEST_F(ViewerTest, SmokeFramesRunFromTheCommandLine) {
    saveSettings({.width = 480, .height = 320, .resolutionScale = 0.25f}, at("config/penumbra/viewer.json"));
    EXPECT_EQ(run("penumbra view two-boxes --smoke-frames 10"), 0);
    EXPECT_EQ(run("penumbra view no-such-scene --smoke-frames 1"), 3);
}

TEST(ViewerWithoutDisplay, SaysSo) {
    unsetenv("DISPLAY");
    const int status = std::system(PENUMBRA_COMMAND " view two-boxes --smoke-frames 1 2>/dev/null");
    EXPECT_EQ(WEXITSTATUS(status), 4);
}

}  // namespace
}  // namespace penumbra::studio::viewer
