// SPDX-License-Identifier: Apache-2.0
// `render` as a script meets it: pictures, lights, cameras, what `auto` chose.
#include <algorithm>
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "studio/image/image_io.h"
#include "tests/support/command_test.h"

namespace penumbra::studio {
namespace {

double meanOf(const Image& image) {
    return std::accumulate(image.values.begin(), image.values.end(), 0.0) / double(image.values.size());
}

TEST_F(CommandTest, ACameraOfOnesOwnSeesWhatTheScenesSees) {
    // The second camera of the closed-form scenes is not needed: this one is placed where --look-from can say
    // it.
    const std::string render = "render half-plane -t hard --size 32x32 ";
    ASSERT_EQ(
        run(render + "--look-from=0,3,0.001 --look-at=0,0,0 --ortho-height 2 -o " + at("a.png")).exitCode, 0);
    ASSERT_EQ(
        run(render + "--look-from=0,9,0.003 --look-at=0,0,0 --ortho-height 2 -o " + at("b.png")).exitCode, 0);
    // Without perspective it does not matter from how far one looks.
    EXPECT_EQ(readPng(at("a.png")).image.values, readPng(at("b.png")).image.values);
    ASSERT_EQ(run(render + "--look-from=0,3,0.001 --look-at=0,0,0 --fov 20 -o " + at("c.png")).exitCode, 0);
    EXPECT_NE(readPng(at("a.png")).image.values, readPng(at("c.png")).image.values);
}

TEST_F(CommandTest, ALightMayHaveATechniqueOfItsOwn) {
    const std::string render = "render half-plane -t hard --size 32x32 ";
    ASSERT_EQ(run(render + "--technique-of key=pcf --set pcf.map_size=64 -o " + at("a.png")).exitCode, 0);
    ASSERT_EQ(run("render half-plane -t pcf --set map_size=64 --size 32x32 -o " + at("b.png")).exitCode, 0);
    ASSERT_EQ(run(render + "-o " + at("c.png")).exitCode, 0);
    EXPECT_EQ(readPng(at("a.png")).image.values, readPng(at("b.png")).image.values);
    EXPECT_NE(readPng(at("a.png")).image.values, readPng(at("c.png")).image.values);
}

TEST_F(CommandTest, ExposureIsAutomaticAValueOrAnotherPictures) {
    const std::string render = "render half-plane -t hard --size 32x32 ";
    ASSERT_EQ(run(render + "-o " + at("auto.png")).exitCode, 0);
    const Metadata metadata = readPng(at("auto.png")).metadata;
    ASSERT_TRUE(metadata.contains("penumbra:exposure_ev"));
    const double ev = std::stod(metadata.at("penumbra:exposure_ev"));
    ASSERT_EQ(run(render + "--exposure " + std::to_string(ev + 1) + " -o " + at("darker.png")).exitCode, 0);
    EXPECT_LT(meanOf(readPng(at("darker.png")).image), 0.9 * meanOf(readPng(at("auto.png")).image));
    ASSERT_EQ(run(render + "--exposure lock=" + at("auto.png") + " -o " + at("locked.png")).exitCode, 0);
    const Image locked = readPng(at("locked.png")).image, automatic = readPng(at("auto.png")).image;
    for (std::size_t i = 0; i < locked.values.size(); ++i)
        ASSERT_NEAR(locked.values[i], automatic.values[i], 1.01 / 255);
    ASSERT_EQ(run(render + "--exposure lock=" + at("auto.png") + " -o " + at("linear.exr")).exitCode, 0);
    EXPECT_EQ(run(render + "--exposure lock=" + at("linear.exr") + " -o " + at("again.png")).exitCode, 0);
}

TEST_F(CommandTest, WrongExposuresAreRefused) {
    const std::string render = "render half-plane -t hard --size 8x8 -o " + at("a.png") + " --exposure ";
    for (const char* wrong : {"bright", "nan", "41", "lock", "1e"})
        EXPECT_EQ(run(render + wrong).exitCode, 2) << wrong;
    EXPECT_EQ(run(render + "lock=" + at("nothing.png")).exitCode, 3);
    writePng(at("plain.png"), Image(4, 4, 3, 0.5f));
    const Outcome outcome = run(render + "lock=" + at("plain.png"));
    EXPECT_EQ(outcome.exitCode, 3);
    EXPECT_NE(outcome.err.find("does not say how it was exposed"), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(at("a.png")));
}

TEST_F(CommandTest, AntialiasingAveragesSamplesOfVisibility) {
    const std::string render = "render two-boxes -t hard --size 32x32 --visibility ";
    const auto between = [&](const std::string& file) {
        const Image seen = imageOf(readExr(file), "V");
        return std::ranges::count_if(seen.values, [](float v) { return v > 0 && v < 1; });
    };
    ASSERT_EQ(run(render + at("plain.exr")).exitCode, 0);
    ASSERT_EQ(run(render + at("smooth.exr") + " --antialias 4 -o " + at("smooth.png")).exitCode, 0);
    EXPECT_EQ(between(at("plain.exr")), 0);
    EXPECT_GT(between(at("smooth.exr")), 16);
    EXPECT_EQ(readPng(at("smooth.png")).image.width_px, 32);
    for (const char* wrong : {"0", "9", "-1", "x"})
        EXPECT_EQ(run(render + at("b.exr") + " --antialias " + wrong).exitCode, 2) << wrong;
    EXPECT_EQ(run("render half-plane -t hard --size 8192x8 --antialias 8 -o " + at("c.png")).exitCode, 2);
}

TEST_F(CommandTest, RendersPictureAndVisibility) {
    const Outcome outcome = run("render many-lights -t hard --size 48x32 -o " + at("a.png") +
                                " --visibility " + at("v.exr") + " --json");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(files(), (std::vector<std::string>{"a.png", "v.exr"}));
    const PngPicture picture = readPng(at("a.png"));
    EXPECT_EQ(picture.image.width_px, 48);
    EXPECT_EQ(picture.image.height_px, 32);
    EXPECT_NE(picture.metadata.at("penumbra:command").find("many-lights"), std::string::npos);
    const ExrPicture visibility = readExr(at("v.exr"));
    EXPECT_EQ(visibility.channels.size(), 5u);
    EXPECT_TRUE(visibility.channels.front().name.ends_with(".V")) << visibility.channels.front().name;
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json.at("lights").size(), 5u);
}

TEST_F(CommandTest, WithoutATechniqueAutoIsTaken) {
    const auto visibility = [&](const std::string& file, const std::string& flags) {
        const Outcome outcome =
            run("render two-boxes --size 32x24 -o " + at("a.png") + " --visibility " + at(file) + flags);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return readExr(at(file)).channels.at(0).values;
    };
    const std::vector<float> automatic = visibility("auto.exr", " -t auto");
    EXPECT_EQ(visibility("default.exr", ""), automatic);
    EXPECT_EQ(visibility("asked.exr", " --error 0.02"), automatic);
    EXPECT_NE(visibility("hard.exr", " -t hard"), automatic) << "this scene does not tell techniques apart";
    EXPECT_NE(run("render --help").out.find("auto"), std::string::npos);
}

TEST_F(CommandTest, AnErrorOrATimeThatCannotBeKeptIsRefused) {
    const auto refusal = [&](const std::string& flags) {
        const Outcome outcome = run("render two-boxes --size 32x24 -o " + at("a.png") + " " + flags);
        EXPECT_NE(outcome.exitCode, 0) << flags;
        EXPECT_FALSE(std::filesystem::exists(at("a.png"))) << flags;
        return outcome.err;
    };
    for (const char* error : {"0", "-1", "nan", "1.5"}) {
        EXPECT_NE(refusal(std::string("--error=") + error).find("--error"), std::string::npos) << error;
    }
    for (const char* budget : {"0", "-1", "nan"}) {
        EXPECT_NE(refusal(std::string("--budget-ms=") + budget).find("--budget-ms"), std::string::npos)
            << budget;
    }
    EXPECT_NE(refusal("--error 0.00001").find("no technique promises less than 0.0"), std::string::npos);
    EXPECT_NE(refusal("-t pcss --error 0.01").find("the smallest that 'pcss' can promise is 0."),
              std::string::npos);
    EXPECT_NE(refusal("-t smoothies --error 0.01").find("'smoothies' promises no error"), std::string::npos);
    EXPECT_NE(refusal("-t exact --budget-ms 5").find("'-t auto' keeps to a time"), std::string::npos);
}

TEST_F(CommandTest, WhatWasChosenIsTold) {
    const Outcome outcome = run("render two-boxes --size 32x24 --error 0.03 --json");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const auto statistics = nlohmann::json::parse(outcome.out).at("lights").at(0).at("statistics");
    EXPECT_TRUE(statistics.at("chosen").contains("technique"));
    EXPECT_LE(statistics.at("counts").at("error promised").get<double>(), 0.03);
    const Outcome named = run("render two-boxes --size 32x24 -t exact --error 0.03 --json");
    EXPECT_EQ(named.exitCode, 0) << named.err;
    EXPECT_FALSE(nlohmann::json::parse(named.out).at("lights").at(0).at("statistics").contains("chosen"));
}

TEST_F(CommandTest, WithABudgetThePictureIsTheSteadyStates) {
    // Far too little time: the error has given way when the picture is made, and both are told.
    const Outcome outcome = run("compare two-boxes -t auto --size 32x24 --samples 16 --budget-ms 0.001");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("budget 0.001 ms, spent "), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("the budget gave way"), std::string::npos) << outcome.out;
    const Outcome refused = run("render two-boxes --size 32x24 --json --error 0.00001 --budget-ms 0.001");
    EXPECT_NE(refused.exitCode, 0) << "neither can be kept";
    EXPECT_NE(refused.err.find("no technique promises less than"), std::string::npos) << refused.err;
}

TEST_F(CommandTest, OneLightsVisibilityIsChannelVAndOneThatOtherProgramsShow) {
    ASSERT_EQ(run("render two-boxes -t hard --size 32x32 --visibility " + at("v.exr")).exitCode, 0);
    const ExrPicture seen = readExr(at("v.exr"));
    EXPECT_EQ(seen.channels.size(), 2u);
    EXPECT_EQ(imageOf(seen, "Y").values, imageOf(seen, "V").values);

    ASSERT_EQ(run("render textured-window -t hard --size 32x32 --visibility " + at("c.exr")).exitCode, 0);
    const ExrPicture coloured = readExr(at("c.exr"));
    EXPECT_EQ(coloured.channels.size(), 6u);
    EXPECT_EQ(imageOf(coloured, "").values, imageOf(coloured, "V").values);
}

TEST_F(CommandTest, ALightThatLightsNothingIsToldOf) {
    write("in.lights.json", R"({"version": 1, "lights": [
        {"name": "lost", "type": "SphereLight", "radius": 0.05, "translation": [-0.75, 2, 0]},
        {"name": "fine", "type": "SphereLight", "radius": 0.05, "translation": [0, 3, 0]}]})");
    const Outcome outcome = run("render two-boxes -t exact --size 32x24 --frames 1-2 --lights " +
                                at("in.lights.json") + " -o " + at("#.png"));
    EXPECT_EQ(outcome.exitCode, 0);
    const std::string warning = "light 'lost' lights nothing of the picture: 'box 1' encloses it";
    const auto first = outcome.err.find(warning);
    ASSERT_NE(first, std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find(warning, first + 1), std::string::npos) << "once";
    EXPECT_EQ(outcome.err.find("'fine'"), std::string::npos) << outcome.err;
}

TEST_F(CommandTest, ExrIsLinearRadiance) {
    ASSERT_EQ(run("render two-boxes -t hard --size 32x32 -o " + at("a.exr")).exitCode, 0);
    const ExrPicture picture = readExr(at("a.exr"));
    ASSERT_EQ(picture.channels.size(), 3u);
    EXPECT_GT(std::ranges::max(picture.channels.front().values), 10) << "nits";
}

TEST_F(CommandTest, FramesAreNumberedAndCanBeTakenUpAgain) {
    const std::string render = "render moving -t hard --size 32x24 --frames 1-5x2 --skip-existing -o ";
    ASSERT_EQ(run(render + at("f.####.png")).exitCode, 0);
    EXPECT_EQ(files(), (std::vector<std::string>{"f.0001.png", "f.0003.png", "f.0005.png"}));
    EXPECT_NE(readText(at("f.0001.png")), readText(at("f.0005.png"))) << "it moves";

    fs::remove(at("f.0003.png"));
    write("f.0001.png", "kept");
    ASSERT_EQ(run(render + at("f.####.png")).exitCode, 0);
    EXPECT_EQ(readText(at("f.0001.png")), "kept");
    EXPECT_TRUE(fs::exists(at("f.0003.png")));
}

TEST_F(CommandTest, SceneWithoutTrianglesIsAPicture) {
    write("empty.gltf", "{\"asset\": {\"version\": \"2.0\"}, \"scenes\": [{}], \"scene\": 0}");
    const Outcome outcome = run("render " + at("empty.gltf") + " -t hard --size 32x32 -o " + at("a.png"));
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_TRUE(fs::exists(at("a.png")));
}

/// A ball of eight triangles, shaded smoothly: its normals are its corners.
std::string coarseBall() {
    return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 0}, "indices": 1}]}],
        "buffers": [{"uri": "ball.bin", "byteLength": 96}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 72},
                        {"buffer": 0, "byteOffset": 72, "byteLength": 24}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3",
                       "min": [-1, -1, -1], "max": [1, 1, 1]},
                      {"bufferView": 1, "componentType": 5121, "count": 24, "type": "SCALAR"}]})";
}
std::string cornersOfCoarseBall() {
    constexpr std::array<float, 18> corners = {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
    constexpr std::array<std::uint8_t, 24> triangles = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4,
                                                        2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
    return std::string(reinterpret_cast<const char*>(corners.data()), sizeof corners) +
           std::string(reinterpret_cast<const char*>(triangles.data()), sizeof triangles);
}

TEST_F(CommandTest, TheTerminatorIsSmoothInPicturesOfFiles) {
    write("ball.gltf", coarseBall());
    write("ball.bin", cornersOfCoarseBall());
    write("ball.lights.json", R"({"version": 1, "lights": [
        {"name": "sun", "type": "DistantLight", "angle": 0.5, "intensity": 50000, "altitude": 20, "azimuth": 80}]})");
    int count = 0;
    const auto output = [&] { return at(std::to_string(++count) + ".out"); };
    const auto picture = [&](const std::string& scene, const std::string& flags) {
        const std::string file = output() + ".png";
        const Outcome outcome = run("render " + scene + " -t hard --size 48x32 -o " + file + flags);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return readPng(file).image.values;
    };
    const auto visibility = [&](const std::string& flags) {
        const std::string file = output() + ".exr";
        const Outcome outcome =
            run("render " + at("ball.gltf") + " -t hard --size 48x32 --visibility " + file + flags);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return readExr(file).channels.at(0).values;
    };
    const std::string smooth = " --terminator smooth", faceted = " --terminator faceted";
    EXPECT_NE(picture(at("ball.gltf"), smooth), picture(at("ball.gltf"), faceted));
    EXPECT_EQ(picture(at("ball.gltf"), ""), picture(at("ball.gltf"), smooth));
    EXPECT_EQ(picture("torus", ""), picture("torus", faceted)) << "built-in scenes are measured";
    EXPECT_NE(visibility(smooth), visibility(faceted));
    EXPECT_EQ(visibility(""), visibility(faceted));
}

TEST_F(CommandTest, AnotherTerminatorIsRefused) {
    const Outcome outcome = run("render torus --terminator round --size 8x8 -o " + at("a.png"));
    EXPECT_EQ(outcome.exitCode, 2);
    for (const char* said : {"--terminator", "smooth", "faceted", "round"})
        EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
    EXPECT_EQ(files(), std::vector<std::string>{});
}

TEST_F(CommandTest, LightsFileReplacesTheScenesLights) {
    write(
        "sun.json",
        R"({"version": 1, "lights": [{"name": "sun", "type": "DistantLight", "angle": 0.53, "intensity": 50000}]})");
    const Outcome outcome = run("info two-boxes --lights " + at("sun.json"));
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("sun: DistantLight of 0.53 degrees"), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace penumbra::studio
