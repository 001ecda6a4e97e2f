// SPDX-License-Identifier: Apache-2.0
// Lights by hand on a scene: nodes, materials, textures.
#include "studio/scene/builtin/builtin.h"
#include "studio/scene/lights/sidecar.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "studio/errors.h"

namespace penumbra::studio {
namespace {

std::string errorOf(const std::string& json) {
    try {
        parseSidecar(json, "chair.lights.json");
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

/// Two nodes; the second moves with time, turned and scaled. One instance on each.
class TwoNodes : public Scene::Motion {
  public:
    SceneMoment at(const Scene&, double time_s) const override {
        SceneMoment moment;
        moment.time_s = time_s;
        // A quarter turn about Y (x to -z), scaled by 2 and mirrored in its own x.
        const glm::mat4 lamp({0, 0, 2, 0}, {0, 2, 0, 0}, {2, 0, 0, 0}, {float(time_s), 1, 0, 1});
        moment.worldFromNode = {glm::mat4(1), lamp};
        moment.instances = {{0, 0, glm::mat4(1)}, {1, 1, lamp}};
        moment.lights = {Light{.name = "of the file"}};
        return moment;
    }
};

Scene twoNodes() {
    Scene scene;
    scene.nodeNames = {"Sky", "Lamp"};
    scene.materials = {{.name = "Blue"}, {.name = "Glass 1"}};
    scene.meshes = {{.name = "dome"}, {.name = "globe", .material = 1}};
    scene.motion = std::make_shared<TwoNodes>();
    return scene;
}

std::string applyErrorOf(const std::string& json, Scene scene = twoNodes(),
                         const std::filesystem::path& folder = ".") {
    try {
        applySidecar(scene, parseSidecar(json, "chair.lights.json"), folder);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

TEST(SidecarOnAScene, ReplacesTheLightsAndFollowsNodes) {
    Scene scene = twoNodes();
    applySidecar(scene,
                 parseSidecar(R"({"version": 1, "lights": [
        {"name": "fixed", "type": "SphereLight", "translation": [1, 2, 3]},
        {"name": "carried", "type": "DiskLight", "radius": 0.25, "node": "Lamp", "translation": [0, 0, 1]}]})",
                              "f"),
                 ".");
    const SceneMoment moment = scene.at(5);
    ASSERT_EQ(moment.lights.size(), 2u);
    EXPECT_EQ(std::bit_cast<glm::mat4>(moment.lights[0].shape.worldFromLight)[3], glm::vec4(1, 2, 3, 1));
    const Light& carried = moment.lights[1];
    const glm::mat4 worldFromLight = std::bit_cast<glm::mat4>(carried.shape.worldFromLight);
    EXPECT_EQ(worldFromLight[3], glm::vec4(7, 1, 0, 1)) << "the node scales where the light is";
    EXPECT_EQ(carried.shape.radius_m, 0.25f) << "but not how large it is";
    EXPECT_EQ(worldFromLight[2], glm::vec4(1, 0, 0, 0));
    EXPECT_EQ(worldFromLight[1], glm::vec4(0, 1, 0, 0));
    EXPECT_EQ(worldFromLight[0], glm::vec4(0, 0, -1, 0)) << "right-handed, though the node mirrors";
}

TEST(SidecarOnAScene, LightsHangBelowNodes) {
    Scene scene = makeBuiltin("two-boxes");
    const SceneMoment before = scene.at(0);
    const int node = before.instances.back().node;
    applySidecar(
        scene,
        parseSidecar(R"({"version": 1, "lights": [{"name": "panel", "type": "RectLight", "below": ")" +
                         scene.nodeNames[std::size_t(node)] + R"(", "translation": [0.1, -0.05, 0]}]})",
                     "f"),
        ".");
    Bounds bounds;
    for (const glm::vec3& position : scene.meshes[std::size_t(before.instances.back().mesh)].positions)
        bounds.include(glm::vec3(before.instances.back().worldFromMesh * glm::vec4(position, 1)));
    const glm::mat4 placed = std::bit_cast<glm::mat4>(scene.at(0).lights.at(0).shape.worldFromLight);
    EXPECT_NEAR(placed[3].x, bounds.center().x + 0.1f, 1e-5f);
    EXPECT_NEAR(placed[3].y, bounds.min.y - 0.05f, 1e-5f);
    EXPECT_NEAR(placed[3].z, bounds.center().z, 1e-5f);
    EXPECT_NEAR(placed[2].y, 1, 1e-6f) << "it shines down";
}

TEST(SidecarOnAScene, PatternsNameManyNodesAndNobodyIsTold) {
    Scene scene = twoNodes();
    applySidecar(
        scene,
        parseSidecar(R"({"version": 1, "nodes": {"*": {"casts": false}, "Ifc*": {"casts": true}}})", "f"),
        ".");
    const SceneMoment moment = scene.at(0);
    EXPECT_FALSE(moment.instances[0].casts);
    EXPECT_FALSE(moment.instances[1].casts);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_EQ(scene.warnings[0], "f:1: no node is named 'Ifc*'");
}

TEST(SidecarOnAScene, RulesOfMaterialsYieldToThoseOfNodes) {
    const auto lampOf = [](const std::string& rules) {
        Scene scene = twoNodes();
        applySidecar(scene, parseSidecar("{\"version\": 1, " + rules + "}", "f"), ".");
        EXPECT_TRUE(scene.at(0).instances[0].casts) << "of another material";
        return scene.at(0).instances[1];
    };
    EXPECT_FALSE(lampOf(R"("materials": {"Glass*": {"casts": false}})").casts);
    EXPECT_FALSE(lampOf(R"("materials": {"Glass 1": {"receives": false}})").receives);
    EXPECT_TRUE(
        lampOf(R"("nodes": {"Lamp": {"casts": true}}, "materials": {"Glass*": {"casts": false}})").casts);

    Scene scene = twoNodes();
    applySidecar(scene, parseSidecar(R"({"version": 1, "materials": {"Ifc*": {"casts": false}}})", "f"), ".");
    EXPECT_EQ(scene.warnings, std::vector<std::string>{"f:1: no material is named 'Ifc*'"});
    EXPECT_EQ(applyErrorOf(R"({"version": 1, "materials": {"Glas 1": {}}})"),
              "chair.lights.json:1: the scene has no material 'Glas 1'; did you mean 'Glass 1'?");
    EXPECT_EQ(errorOf(R"({"version": 1, "materials": {"A": {"cast": true}}})"),
              "chair.lights.json:1: unknown key 'cast' in material 'A'; did you mean 'casts'?");
}

TEST(SidecarOnAScene, WithoutLightsKeepsThemAndClassifiesNodes) {
    Scene scene = twoNodes();
    applySidecar(scene,
                 parseSidecar(R"({"version": 1, "nodes": {"Sky": {"casts": false, "receives": false},
                                                                  "Lamp": {"receives": false}}})",
                              "f"),
                 ".");
    const SceneMoment moment = scene.at(0);
    ASSERT_EQ(moment.lights.size(), 1u);
    EXPECT_EQ(moment.lights[0].name, "of the file");
    EXPECT_FALSE(moment.instances[0].casts);
    EXPECT_FALSE(moment.instances[0].receives);
    EXPECT_TRUE(moment.instances[1].casts);
    EXPECT_FALSE(moment.instances[1].receives);
}

TEST(SidecarOnAScene, AnEmptyListOfLightsIsNone) {
    Scene scene = twoNodes();
    applySidecar(scene, parseSidecar(R"({"version": 1, "lights": []})", "f"), ".");
    EXPECT_TRUE(scene.at(0).lights.empty());
}

TEST(SidecarOnAScene, UnknownAndAmbiguousNodes) {
    EXPECT_EQ(applyErrorOf("{\"version\": 1, \"nodes\": {\n\"Lmp\": {}}}"),
              "chair.lights.json:2: the scene has no node 'Lmp'; did you mean 'Lamp'?");
    const std::string hung =
        "{\"version\": 1, \"lights\": [{\"name\": \"a\", \"type\": \"DiskLight\",\n \"node\": \"Lamp\"}]}";
    Scene scene = twoNodes();
    scene.nodeNames = {"Lamp", "Lamp"};
    EXPECT_EQ(applyErrorOf(hung, scene),
              "chair.lights.json:2: the scene has 2 nodes named 'Lamp'; a light can hang on one only");
    EXPECT_EQ(applyErrorOf("{\"version\": 1, \"nodes\": {\"Lamp\": {\"casts\": false}}}", scene), "no error");
}

TEST(SidecarOnAScene, ALightHangsOnTheOneNodeThatAPatternFits) {
    const auto hung = [](std::string_view pattern, std::vector<std::string> names) {
        Scene scene = twoNodes();
        scene.nodeNames = std::move(names);
        return applyErrorOf(
            fmt::format(R"({{"version": 1, "lights": [{{"name": "a", "type": "DiskLight", "node": "{}"}}]}})",
                        pattern),
            scene);
    };
    EXPECT_EQ(hung("IfcLamp*", {"IfcLamp_desk_0Kx1", "IfcWall_0Kx2"}), "no error");
    EXPECT_EQ(hung("Ifc*", {"IfcLamp_desk_0Kx1", "IfcWall_0Kx2"}),
              "chair.lights.json:1: the scene has 2 nodes named 'Ifc*'; a light can hang on one only");
    EXPECT_EQ(hung("IfcDoor*", {"IfcLamp_desk_0Kx1", "IfcWall_0Kx2"}),
              "chair.lights.json:1: no node is named 'IfcDoor*'");
}

class SidecarTextures : public testing::Test {
  protected:
    std::filesystem::path folder =
        std::filesystem::temp_directory_path() /
        ("penumbra-sidecar-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));

    void SetUp() override { std::filesystem::create_directories(folder / "sub"); }
    void TearDown() override { std::filesystem::remove_all(folder); }

    void write(const std::filesystem::path& name, const std::string& content) const {
        std::ofstream(folder / name, std::ios::binary) << content;
    }

    static std::string windowed(const std::string& file) {
        return "{\"version\": 1, \"lights\": [{\"name\": \"a\", \"type\": \"RectLight\",\n \"texture:file\": "
               "\"" +
               file + "\"}]}";
    }
};

/// A PNG of 1 x 1 pixel, red.
const std::string& redPixel() {
    static constexpr unsigned char bytes[] = {
        0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
        0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00,
        0x00, 0x90, 0x77, 0x53, 0xde, 0x00, 0x00, 0x00, 0x0c, 0x49, 0x44, 0x41, 0x54, 0x78,
        0x9c, 0x63, 0xf8, 0xcf, 0xc0, 0x00, 0x00, 0x03, 0x01, 0x01, 0x00, 0xc9, 0xfe, 0x92,
        0xef, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
    static const std::string png(std::begin(bytes), std::end(bytes));
    return png;
}

TEST_F(SidecarTextures, AreReadOnceAndBelongToTheScene) {
    write("sub/red.png", redPixel());
    Scene scene = twoNodes();
    applySidecar(scene,
                 parseSidecar(R"({"version": 1, "lights": [
        {"name": "a", "type": "RectLight", "texture:file": "sub/red.png"},
        {"name": "b", "type": "RectLight"},
        {"name": "c", "type": "RectLight", "texture:file": "sub/red.png"}]})",
                              "f"),
                 folder);
    ASSERT_EQ(scene.textures.size(), 1u);
    ASSERT_EQ(scene.pictures.size(), 1u);
    EXPECT_EQ(scene.pictures[0].rgba, (std::vector<std::uint8_t>{255, 0, 0, 255}));
    const auto lights = scene.at(0).lights;
    EXPECT_EQ(lights[0].texture, 0);
    EXPECT_EQ(lights[1].texture, -1);
    EXPECT_EQ(lights[2].texture, 0);
}

TEST_F(SidecarTextures, AreConfinedToTheFolder) {
    write("outside.png", redPixel());
    write("sub/inside.png", redPixel());
    std::filesystem::create_symlink(folder / "outside.png", folder / "sub/link.png");
    const auto refused = [&](const std::string& file) {
        EXPECT_EQ(applyErrorOf(windowed(file), twoNodes(), folder / "sub"),
                  "chair.lights.json:2: 'texture:file' must be a path beneath the file's own folder, not '" +
                      file + "'");
    };
    refused("../outside.png");
    refused("../sub/inside.png");
    refused((folder / "outside.png").string());
    refused("link.png");
    refused("http://example.org/a.png");
    EXPECT_EQ(applyErrorOf(windowed("inside.png"), twoNodes(), folder / "sub"), "no error");
}

TEST_F(SidecarTextures, ThatAreMissingOrBroken) {
    write("broken.png", redPixel().substr(0, 40));
    EXPECT_EQ(applyErrorOf(windowed("none.png"), twoNodes(), folder),
              "chair.lights.json:2: '" + (folder / "none.png").string() + "' does not exist");
    EXPECT_EQ(applyErrorOf(windowed("sub"), twoNodes(), folder),
              "chair.lights.json:2: '" + (folder / "sub").string() + "' is not a file");
    EXPECT_TRUE(applyErrorOf(windowed("broken.png"), twoNodes(), folder)
                    .starts_with("chair.lights.json:2: picture 'broken.png' is damaged"))
        << applyErrorOf(windowed("broken.png"), twoNodes(), folder);
}

}  // namespace
}  // namespace penumbra::studio
