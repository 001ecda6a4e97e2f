// SPDX-License-Identifier: Apache-2.0
// What the window leaves behind and lives with: files, settings, wrong input, sizes, time.
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "studio/image/downsample.h"
#include "studio/image/image_io.h"
#include "tests/viewer/viewer_fixture.h"

namespace penumbra::studio::viewer {
namespace {

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
    ASSERT_TRUE(std::filesystem::exists(at("two-boxes.001.png"))) << viewer().windowState().message;
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

TEST_F(ViewerTest, APictureAtRestIsRefined) {
    start("two-boxes");
    ViewerOptions patient = options("two-boxes");
    patient.refine_ms = std::numeric_limits<double>::infinity();
    viewer_.reset();
    saveSettings(
        {.width = 600, .height = 400, .resolutionScale = 0.5f, .referenceRuns = false, .technique = "hard"},
        at("viewer.json"));
    viewer_ = std::make_unique<Viewer>(patient);
    frames(3);
    const Image plain = canvas();
    framesUntil([&] { return session().isRefined(); });
    const gl::Texture& shown = session().shown();
    // From half of the window's pixels to four samples for each.
    EXPECT_EQ(session().refinedSamples(), 4);
    ASSERT_EQ(shown.width_px(), 4 * session().width_px());
    ASSERT_EQ(shown.height_px(), 4 * session().height_px());
    const Image refined = downsampled(readTexture(shown.name(), shown.width_px(), shown.height_px(), 3), 4);
    EXPECT_LT(shareOfDifferent(refined, plain, 0.1), 0.1) << "it is the same picture,";
    EXPECT_GT(shareOfDifferent(refined, plain, 0.1), 0) << "with other edges";
    EXPECT_TRUE(samePixels(canvas(), plain)) << "what is kept of it is what it was";

    Display::input(to(0.9, 0.9));
    key("2");  // another technique
    EXPECT_FALSE(session().isRefined());
    framesUntil([&] { return session().isRefined(); });
    key("c");  // two sides
    frames(2);
    session().refine(600, 400, patient.refine_ms);
    EXPECT_FALSE(session().isRefined());
}

TEST_F(ViewerTest, WhatIsKeptOfAReducedPictureIsNotReduced) {
    start("two-boxes");
    const int width_px = session().width_px(), height_px = session().height_px();
    ViewerOptions hasty = options("two-boxes");
    hasty.late_ms = 0;  // every picture is late
    viewer_.reset();
    viewer_ = std::make_unique<Viewer>(hasty);
    frames(3);
    const auto reduce = [&] {
        Display::input(to(0.4, 0.5));
        frames(2);
        Display::input("mousedown 1");
        frames(1);
        for (const double x : {0.45, 0.5, 0.55, 0.6}) {
            Display::input(to(x, 0.5));
            frames(1);
        }
        EXPECT_LT(session().width_px(), width_px) << "the picture is not reduced, which this is about";
    };
    reduce();
    key("ctrl+c");
    EXPECT_NE(viewer().window().clipboard().find(fmt::format(" --size {}x{} ", width_px, height_px)),
              std::string::npos)
        << viewer().window().clipboard();
    Display::input("mouseup 1");
    frames(2);
    reduce();
    key("F2");
    Display::input("mouseup 1");
    frames(2);
    EXPECT_EQ(readPng(at("two-boxes.001.png")).image.width_px, width_px) << viewer().windowState().message;
    EXPECT_EQ(readExr(at("two-boxes.001.exr")).height_px, height_px);
}

TEST_F(ViewerTest, PicturesAreOfTheWindowsFullSizeAndLieBesideTheScene) {
    std::filesystem::create_directories(at("rooms"));
    saveSettings(
        {.width = 500, .height = 340, .resolutionScale = 0.25f, .referenceRuns = false, .technique = "hard"},
        at("viewer.json"));
    viewer_ = std::make_unique<Viewer>(options(writeScene("rooms/box.gltf")));
    frames();
    const int width_px = int(viewer().canvasPlace().size.x);
    ASSERT_LT(session().width_px(), width_px);
    key("F2");
    ASSERT_TRUE(std::filesystem::exists(at("rooms/box.001.png"))) << viewer().windowState().message;
    const PngPicture full = readPng(at("rooms/box.001.png"));
    EXPECT_EQ(full.image.width_px, width_px);
    ASSERT_EQ(run(full.metadata.at("penumbra:command")), 0);
    EXPECT_TRUE(samePixels(readPng(at("picture.png")).image, full.image))
        << full.metadata.at("penumbra:command");
    EXPECT_LT(session().width_px(), width_px) << "what is shown is as it was";

    clickWidget("File");
    clickWidget("Size of pictures");
    clickWidget("1280 x 720");
    key("F2");
    EXPECT_EQ(readPng(at("rooms/box.002.png")).image.height_px, 720) << viewer().windowState().message;
    key("ctrl+c");
    EXPECT_NE(viewer().window().clipboard().find("--size 1280x720"), std::string::npos);
}

TEST_F(ViewerTest, ViewsAreKeptAndUndone) {
    start(writeScene("box.gltf"));
    drag(0.3, 0.6, 0.5, 0.5);
    const Image kept = picture();
    key("b");
    ASSERT_EQ(session().choices().bookmarks.size(), 1u);
    key("r");
    EXPECT_GT(shareOfDifferent(kept, picture()), 0.01);
    clickWidget("Camera");
    clickWidget("View 1");
    EXPECT_LE(shareOfDifferent(kept, picture(), 2.01 / 255), 0.01);
    key("ctrl+z");
    EXPECT_TRUE(session().choices().bookmarks.empty());
    key("ctrl+shift+z");
    EXPECT_EQ(session().choices().bookmarks.size(), 1u);
    viewer_.reset();
    viewer_ = std::make_unique<Viewer>(options(at("box.gltf")));
    frames();
    EXPECT_EQ(session().choices().bookmarks.size(), 1u) << "it is there again the next time";
}

TEST_F(ViewerTest, RecentFilesAreAbsoluteOnceEach) {
    start(writeScene("box.gltf"));
    ViewerOptions relative = options(std::filesystem::relative(at("box.gltf")).string());
    viewer_.reset();
    viewer_ = std::make_unique<Viewer>(relative);
    frames();
    const std::vector<RecentFile>& recent = viewer().settings().recentFiles;
    ASSERT_EQ(recent.size(), 1u);
    EXPECT_TRUE(std::filesystem::path(recent[0].scene).is_absolute()) << recent[0].scene;
}

TEST_F(ViewerTest, AFileIsChosenByLooking) {
    std::filesystem::create_directories(at("rooms"));
    start(writeScene("box.gltf"));
    const std::string other = writeScene("rooms/other.gltf");
    key("ctrl+o");
    Display::input("type " + folder_.path().string());
    frames();
    key("Return");  // a folder is looked into
    ASSERT_TRUE(widget("box.gltf")) << "scenes,";
    EXPECT_FALSE(widget("viewer.json")) << "and nothing else";
    clickWidget("rooms/", 0.1);
    clickWidget("other.gltf", 0.1);
    EXPECT_EQ(std::filesystem::canonical(session().document().nameOrPath()),
              std::filesystem::canonical(other));
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
    EXPECT_EQ(viewer().settings().recentFiles.front(), (RecentFile{"two-boxes", ""}));
}

TEST_F(ViewerTest, AnimationPlaysPausesAndIsRecorded) {
    start("moving");
    key("space");
    EXPECT_TRUE(viewer().windowState().playing);
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

    viewer().windowState().recording = {at("frames"), 3, 5, 24};
    clickWidget("Record");
    framesUntil([&] { return !viewer().recorder().active(); });
    ASSERT_TRUE(std::filesystem::exists(at("frames/frame.0005.png"))) << viewer().windowState().message;
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
    EXPECT_TRUE(viewer().windowState().messageIsError);
    EXPECT_NE(viewer().windowState().message.find("broken.gltf"), std::string::npos);
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
    EXPECT_NE(viewer().windowState().message.find("missing.glb"), std::string::npos);
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
            if (!name.ends_with(".glsl") && !name.ends_with(".h")) continue;
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
    ASSERT_FALSE(viewer().windowState().showsPanel);
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
