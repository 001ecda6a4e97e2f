// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/open_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "studio/errors.h"
#include "studio/scene/builtin/builtin.h"
#include "studio/scene/builtin/placing.h"

namespace penumbra::studio {
namespace {

namespace fs = std::filesystem;

std::string errorOf(const std::string& nameOrPath, const OpenOptions& options = {}) {
    try {
        openScene(nameOrPath, options);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

/// One triangle on a node "T" and, if asked for, a point light and a camera of the file's own.
std::string triangleGltf(bool withLight, bool withCamera) {
    // Positions (0,0,0), (1,0,0), (0,1,0).
    return std::string(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0)") +
           (withLight ? ", 1" : "") + (withCamera ? (withLight ? ", 2" : ", 1") : "") + R"(]}],
  "nodes": [{"name": "T", "mesh": 0})" +
           (withLight
                ? R"(, {"name": "L", "translation": [0, 3, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}})"
                : "") +
           (withCamera ? R"(, {"name": "C", "camera": 0, "translation": [0, 0, 5]})" : "") + R"(],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}],
  "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}])" +
           (withLight ? R"(, "extensionsUsed": ["KHR_lights_punctual"],
  "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "name": "own", "intensity": 40}]}})"
                      : "") +
           (withCamera
                ? R"(, "cameras": [{"type": "perspective", "name": "own", "perspective": {"yfov": 0.5, "znear": 0.1}}])"
                : "") +
           "}";
}

class OpenScene : public testing::Test {
  protected:
    fs::path folder =
        fs::temp_directory_path() /
        ("penumbra-open-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));

    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(folder); }

    std::string write(const std::string& name, const std::string& content) const {
        std::ofstream(folder / name, std::ios::binary) << content;
        return (folder / name).string();
    }
};

const std::string sidecar = R"({"version": 1, "lights": [{"name": "beside", "type": "SphereLight"}]})";
const std::string otherLights = R"({"version": 1, "lights": [{"name": "asked for", "type": "DiskLight"}]})";

TEST_F(OpenScene, LightsOfAFlagBeatTheSidecarBeatsTheFile) {
    const std::string chair = write("chair.gltf", triangleGltf(true, true));
    const auto names = [&](const OpenOptions& options) {
        std::string all;
        for (const Light& light : openScene(chair, options).at(0).lights) all += light.name + ";";
        return all;
    };
    EXPECT_EQ(names({}), "own;");
    write("chair.lights.json", sidecar);
    EXPECT_EQ(names({}), "beside;");
    OpenOptions asked;
    asked.lightsFile = write("other.json", otherLights);
    EXPECT_EQ(names(asked), "asked for;");
    EXPECT_TRUE(openScene(chair).warnings.empty());
}

TEST_F(OpenScene, AddsWhatIsMissingAndSaysSo) {
    const Scene scene = openScene(write("bare.gltf", triangleGltf(false, false)));
    const SceneMoment moment = scene.at(0);
    ASSERT_EQ(moment.lights.size(), 1u);
    ASSERT_EQ(moment.cameras.size(), 1u);
    EXPECT_EQ(moment.lights[0].name, "default key");
    ASSERT_EQ(scene.warnings.size(), 2u);
    EXPECT_NE(scene.warnings[0].find("bare.gltf has no light: added a key light"), std::string::npos)
        << scene.warnings[0];
    EXPECT_NE(scene.warnings[1].find("has no camera"), std::string::npos) << scene.warnings[1];
}

TEST_F(OpenScene, AnEmptySidecarGetsTheDefaultLight) {
    const std::string chair = write("chair.gltf", triangleGltf(true, true));
    write("chair.lights.json", R"({"version": 1, "lights": []})");
    const Scene scene = openScene(chair);
    ASSERT_EQ(scene.at(0).lights.size(), 1u);
    EXPECT_EQ(scene.at(0).lights[0].name, "default key");
}

TEST_F(OpenScene, AFileOfLightsSaysHowTheModelIsReadUnlessAFlagDoes) {
    const std::string chair = write("chair.gltf", triangleGltf(true, true));
    const auto top = [&](const ModelReading& reading) {
        return openScene(chair, {.reading = reading}).at(0).bounds.max;
    };
    EXPECT_EQ(top({}), glm::vec3(1, 1, 0));
    // Y of the file points away from who looks, Z up.
    write("chair.lights.json", R"({"version": 1, "unit": "ft", "up": "z"})");
    EXPECT_EQ(top({}), glm::vec3(0.3048f, 0, 0));
    EXPECT_EQ(top({.unit_m = 1}), glm::vec3(1, 0, 0));
    EXPECT_EQ(top({.up = UpAxis::y}), glm::vec3(0.3048f, 0.3048f, 0));
    EXPECT_EQ(openScene(chair).at(0).lights.at(0).name, "own") << "says nothing of lights";
    // The file that is asked for speaks instead of the one beside.
    OpenOptions asked;
    asked.lightsFile = write("other.json", R"({"version": 1, "unit": "cm"})");
    EXPECT_EQ(openScene(chair, asked).at(0).bounds.max, glm::vec3(0.01f, 0.01f, 0));
}

TEST_F(OpenScene, AFileOfLightsSaysWhatGlassDoesUnlessAFlagDoes) {
    std::string pane = triangleGltf(true, true);
    const std::string positions = R"("POSITION": 0})";
    pane.insert(pane.find(positions) + positions.size(), R"(, "material": 0)");
    pane.insert(
        pane.rfind('}'),
        R"(, "materials": [{"alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.25]}}])");
    const std::string file = write("pane.gltf", pane);
    const auto instance = [&](const ModelReading& reading) {
        return openScene(file, {.reading = reading}).at(0).instances.at(0);
    };
    EXPECT_FALSE(instance({}).casts);
    write("pane.lights.json", R"({"version": 1, "glass": "tinted"})");
    EXPECT_TRUE(instance({}).casts);
    EXPECT_EQ(instance({}).transmittance, glm::vec3(0.75f));
    EXPECT_FALSE(instance({.glass = Glass::clear}).casts);
    EXPECT_EQ(instance({.glass = Glass::blocks}).transmittance, glm::vec3(0));
}

TEST_F(OpenScene, HowABuiltinIsReadIsSaidInVain) {
    EXPECT_EQ(openScene("torus", {.reading = {.unit_m = 1e-3}}).warnings,
              std::vector<std::string>{"built-in scene 'torus' is in metres with Y up and without glass: "
                                       "'unit', 'up' and 'glass' are said of it in vain"});
}

TEST_F(OpenScene, BuiltinsTakeAFileOfLightsToo) {
    OpenOptions options;
    options.lightsFile = write(
        "on ball.json", R"({"version": 1, "lights": [{"name": "a", "type": "DiskLight", "node": "ball"}]})");
    const Scene scene = openScene("primitives", options);
    ASSERT_EQ(scene.at(0).lights.size(), 1u);
    EXPECT_NEAR(scene.at(0).lights[0].shape.worldFromLight.columns[3][1], 0.5f, 1e-6);
}

TEST_F(OpenScene, ErrorsSayWhatToDo) {
    EXPECT_EQ(errorOf("primitvies"),
              "there is no file and no built-in scene 'primitvies'; did you mean 'primitives'?");
    EXPECT_EQ(
        errorOf("nothing-of-the-kind.glb"),
        "there is no file and no built-in scene 'nothing-of-the-kind.glb'; 'penumbra list scenes' names the "
        "built-in ones");
    EXPECT_EQ(errorOf(folder.string()),
              "'" + folder.string() + "' is a directory: name a .gltf or .glb file in it");
    const std::string obj = write("a.obj", "v 0 0 0");
    EXPECT_EQ(errorOf(obj),
              "'" + obj +
                  "' is not a scene that can be read: only glTF 2.0, .gltf or .glb; assimp (Debian: "
                  "assimp-utils) writes one: assimp export " +
                  obj + " OUT.glb -fglb2");
    const std::string text = write("a.txt", "v 0 0 0");
    EXPECT_EQ(errorOf(text), "'" + text + "' is not a scene that can be read: only glTF 2.0, .gltf or .glb");
    OpenOptions options;
    options.lightsFile = folder / "none.json";
    EXPECT_EQ(errorOf("torus", options), "lights: '" + (folder / "none.json").string() + "' does not exist");
    options = {.animations = std::vector{1}};
    EXPECT_EQ(errorOf("moving", options), "built-in scene 'moving' has no animation 1: it has 1");
    options = {.scene = 1};
    EXPECT_EQ(errorOf("moving", options), "built-in scene 'moving' has no scene 1: it has one, 0");
}

// What a refusal names is what the page on buildings says, command for command.
TEST_F(OpenScene, RefusalsNameTheConverterThatTheManualRecommends) {
    std::ifstream page(fs::path(PENUMBRA_DOCS) / "manual/buildings.md");
    const std::string manual((std::istreambuf_iterator<char>(page)), {});
    struct Case {
        std::string name, program, output;
    };
    for (const auto& [name, program, output] :
         {Case{"house.ifc", "a script of Penumbra's (npm: web-ifc @gltf-transform/core)", "house.glb"},
          {"house.IFC", "a script of Penumbra's (npm: web-ifc @gltf-transform/core)", "house.glb"},
          {"house.ifczip", "a script of Penumbra's (npm: web-ifc @gltf-transform/core)", "house.glb"},
          {"part.stp", "Open CASCADE (Debian: occt-draw libocct-draw-dev)", "part.glb"},
          {"part.step", "Open CASCADE (Debian: occt-draw libocct-draw-dev)", "part.glb"},
          {"part.brep", "Open CASCADE (Debian: occt-draw libocct-draw-dev)", "part.glb"},
          {"tile.b3dm", "3d-tiles-tools (npm)", "tile.glb"},
          {"tile.i3dm", "3d-tiles-tools (npm)", "tile.glb"},
          {"town.city.json", "a script of Penumbra's (npm: earcut @gltf-transform/core)", "town.glb"},
          {"town.cityjson", "a script of Penumbra's (npm: earcut @gltf-transform/core)", "town.glb"},
          {"home.sh3d", "assimp (Debian: assimp-utils), from what Sweet Home 3D exports of home.sh3d as OBJ,",
           "home.glb"},
          {"house.fbx", "assimp (Debian: assimp-utils)", "house.glb"}}) {
        const std::string file = write(name, "x"), error = errorOf(file);
        const std::string before = "'" + file +
                                   "' is not a scene that can be read: only glTF 2.0, .gltf or .glb; " +
                                   program + " writes one: ";
        ASSERT_TRUE(error.starts_with(before)) << error;
        EXPECT_EQ(error.find('\n'), std::string::npos) << "one line";
        // As the page writes it: a file of this folder, and an output of its name.
        std::string command = error.substr(before.size());
        const auto replace = [&](const std::string& from, const std::string& to) {
            for (auto at = command.find(from); at != std::string::npos;
                 at = command.find(from, at + to.size()))
                command.replace(at, from.size(), to);
        };
        replace(file, name == "house.fbx" ? "house.obj" : name == "house.IFC" ? "house.ifc" : name);
        replace("OUT.glb", output);
        replace("HOME.obj", "home.obj");
        replace("MODEL.ifc", "house.ifc");
        replace("part.step;", "part.stp;");
        replace("town.cityjson", "town.city.json");
        EXPECT_NE(manual.find(command), std::string::npos) << command;
    }
}

TEST(OpenBuiltin, OpensThemAllWithoutWarnings) {
    for (const BuiltinInfo& info : builtinScenes())
        EXPECT_TRUE(openScene(std::string(info.name)).warnings.empty());
}

TEST(FramingCamera, SeesAllCornersAndNotMuchMore) {
    for (const Bounds& bounds :
         {Bounds{{-1, 0, -1}, {1, 2, 1}}, Bounds{{100, -3, 7}, {101, 40, 9}},
          Bounds{{-5e3f, 0, -5e3f}, {5e3f, 1, 5e3f}}, Bounds{{0, 0, 0}, {1e-3f, 0, 0}}}) {
        const Camera camera = framingCamera("c", bounds);
        const glm::mat4 cameraFromWorld = glm::inverse(camera.worldFromCamera);
        const float reach = std::tan(0.5f * camera.yfov_rad);
        float furthest = 0;
        for (int i = 0; i < 8; ++i) {
            const glm::vec3 corner(i & 1 ? bounds.max.x : bounds.min.x, i & 2 ? bounds.max.y : bounds.min.y,
                                   i & 4 ? bounds.max.z : bounds.min.z);
            const glm::vec3 seen(cameraFromWorld * glm::vec4(corner, 1));
            ASSERT_LT(seen.z, 0);
            furthest =
                std::max({furthest, std::abs(seen.x) / -seen.z / reach, std::abs(seen.y) / -seen.z / reach});
        }
        EXPECT_GT(furthest, 0.93f);
        EXPECT_LT(furthest, 0.97f);
    }
}

TEST(KeyLight, IsAQuarterAsLargeAsFarAndAimsAtTheCenter) {
    const Bounds bounds{{-1, 0, -1}, {3, 2, 1}};
    const Light light = keyLight("k", bounds);
    const glm::mat4 worldFromLight = std::bit_cast<glm::mat4>(light.shape.worldFromLight);
    const glm::vec3 fromCenter = glm::vec3(worldFromLight[3]) - bounds.center();
    EXPECT_NEAR(light.shape.width_m / glm::length(fromCenter), 0.25f, 1e-6);
    EXPECT_NEAR(glm::dot(glm::normalize(fromCenter), glm::vec3(worldFromLight[2])), 1, 1e-6);
    EXPECT_GT(glm::length(fromCenter), 2 * bounds.radius());
    // L A / d^2 = E
    EXPECT_NEAR(light.emission.value.x * 0.0625f, 1000, 0.1);
    EXPECT_GT(keyLight("k", Bounds{}).shape.width_m, 0.1f) << "also over nothing";
}

TEST(WorldFromLookAt, LooksAlongMinusZAlsoStraightDown) {
    const glm::mat4 down = worldFromLookAt({1, 5, 2}, {1, 0, 2});
    EXPECT_EQ(down[0], glm::vec4(1, 0, 0, 0));
    EXPECT_EQ(down[1], glm::vec4(0, 0, -1, 0));
    EXPECT_EQ(down[2], glm::vec4(0, 1, 0, 0));
    const glm::mat4 ahead = worldFromLookAt({0, 0, 5}, {0, 0, 0});
    EXPECT_EQ(ahead[2], glm::vec4(0, 0, 1, 0));
    EXPECT_EQ(ahead[1], glm::vec4(0, 1, 0, 0));
}

}  // namespace
}  // namespace penumbra::studio
