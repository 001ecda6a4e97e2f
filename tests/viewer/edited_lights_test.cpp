// SPDX-License-Identifier: Apache-2.0
// What the viewer makes of edited lights, and the file it writes, without a window.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "studio/errors.h"
#include "studio/image/atomic_file.h"
#include "studio/image/image_io.h"
#include "studio/image/test_folder.h"
#include "studio/scene/builtin/builtin.h"
#include "studio/scene/builtin/placing.h"
#include "studio/scene/light_size.h"
#include "studio/viewer/edited_lights.h"
#include "studio/viewer/light_editing.h"

namespace penumbra::studio::viewer {
namespace {

constexpr float pi = glm::pi<float>();

TEST(EditedLights, SizeZeroKeepsWhatTheLightGivesFromAfar) {
    Light bulb = sphereLight("bulb", 0.1f, {0, 2, 0}, {0, 0, 0}, 400);
    const float candela = bulb.emission.value.r * pi * 0.01f;
    setSize(bulb, &AreaLight::radius_m, 0);
    EXPECT_EQ(bulb.emission.unit, Emission::Unit::candela);
    EXPECT_NEAR(bulb.emission.value.r, candela, 1e-3f * candela);
    setSize(bulb, &AreaLight::radius_m, 0.2f);
    EXPECT_EQ(bulb.emission.unit, Emission::Unit::nits);
    EXPECT_NEAR(bulb.emission.value.r, candela / (pi * 0.04f), 1e-3f * candela);
}

TEST(EditedLights, AnotherShapeGivesAsMuchLight) {
    const Light rect = rectLight("key", 0.8f, 0.8f, {0, 3, 0}, {0, 0, 0}, 900);
    for (const LightShape shape : {LightShape::disk, LightShape::sphere, LightShape::distant}) {
        Light changed = rect;
        changeShape(changed, shape);
        EXPECT_EQ(changed.shape.shape, shape);
        // Lux at 3 m: luminance times the solid angle that is shown.
        const float sine = std::sin(0.5f * changed.shape.angle_rad);
        const float solid = shape == LightShape::distant
                                ? pi * sine * sine
                                : pi * changed.shape.radius_m * changed.shape.radius_m / 9;
        EXPECT_NEAR(changed.emission.value.r * solid, 900, 1);
        changeShape(changed, LightShape::rect);
        EXPECT_NEAR(changed.shape.width_m, 0.8f, 1e-3f);
        EXPECT_NEAR(changed.emission.value.r, rect.emission.value.r, 2e-3f * rect.emission.value.r);
    }
}

TEST(EditedLights, ShowsWhatItSaves) {
    const TestFolder folder;
    Scene scene = makeBuiltin("many-lights");
    SceneMoment moment = scene.at(0);
    EditedLights edited(scene);
    const std::vector<Light> own = moment.lights;
    std::vector<Light> lights = own;
    lights[0].shape.width_m = 0.7f;
    lights[1].emission.value = {123.4f, 56.7f, 8.9f};
    lights[2].castsShadow = false;
    lights.push_back(lights[0]);  // the same name twice
    edited.edit(lights, moment, own);
    moment.lights = edited.at(moment, own);
    EXPECT_EQ(moment.lights.back().name, lights[0].name + " 2");
    EXPECT_TRUE(edited.unsaved());
    edited.save(folder / "scene.lights.json");
    EXPECT_FALSE(edited.unsaved());

    Scene again = makeBuiltin("many-lights");
    applySidecar(again, readSidecar(folder / "scene.lights.json"), folder.path());
    const std::vector<Light> read = again.at(0).lights;
    ASSERT_EQ(read.size(), moment.lights.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
        EXPECT_EQ(read[i].name, moment.lights[i].name);
        EXPECT_EQ(read[i].shape.worldFromLight, moment.lights[i].shape.worldFromLight) << i;  // bit for bit
        EXPECT_EQ(read[i].shape.width_m, moment.lights[i].shape.width_m);
        EXPECT_EQ(read[i].shape.radius_m, moment.lights[i].shape.radius_m);
        EXPECT_EQ(read[i].shape.angle_rad, moment.lights[i].shape.angle_rad);
        EXPECT_EQ(read[i].emission.value, moment.lights[i].emission.value);
        EXPECT_EQ(read[i].castsShadow, moment.lights[i].castsShadow);
    }
    edited.revert();
    EXPECT_FALSE(edited.edited());
}

TEST(EditedLights, KeepsWhatTheFileSaysOfNodesAndWritesTextures) {
    const TestFolder folder;
    writeFileAtomically(folder / "a.lights.json",
                        std::string_view(R"({"version": 1, "nodes": {"ball": {"casts": false}}})"));
    Scene scene = makeBuiltin("textured-window");
    SceneMoment moment = scene.at(0);
    EditedLights edited(scene, folder / "a.lights.json");
    edited.edit(moment.lights, moment, moment.lights);
    edited.save(folder / "a.lights.json");
    const Sidecar sidecar = readSidecar(folder / "a.lights.json");
    ASSERT_EQ(sidecar.surfaces.nodes.size(), 1u);
    EXPECT_EQ(sidecar.surfaces.nodes[0].casts, false);
    Scene again = makeBuiltin("textured-window");
    applySidecar(again, sidecar, folder.path());
    const Light light = again.at(0).lights.at(0);
    ASSERT_GE(light.texture, 0);
    const auto pictureOf = [](const Scene& from, const Light& of) {
        return from.pictures[std::size_t(from.textures[std::size_t(of.texture)].picture)].rgba;
    };
    EXPECT_EQ(pictureOf(again, light), pictureOf(scene, moment.lights[0]));
}

constexpr std::string_view statedLights = R"({
  "$schema": "https://example.org/lights.schema.json",
  "nodes": {"ball": {"casts": false}},
  "lights": [
    {"type": "SphereLight", "name": "lamp", "radius": 0.10, "normalize": true, "intensity": 1.50e2,
     "exposure": 2, "color": [1, 0.50, 0.25], "node": "bal?", "translation": [0, 1.0, 0]},
    {"name": "key",   "type": "RectLight", "width": 1.0, "height": 1, "intensity": 300,
     "translation": [-2, 4.60, 2], "aim": [0, 0, 0]}
  ],
  "version": 1
}
)";

/// `moving` with the lights above, at 1 s.
struct StatedLights {
    TestFolder folder;
    std::filesystem::path file = folder / "moving.lights.json";
    Scene scene = makeBuiltin("moving");
    SceneMoment moment;
    std::vector<Light> own;

    StatedLights() {
        writeFileAtomically(file, statedLights);
        applySidecar(scene, readSidecar(file), folder.path());
        show(1);
    }
    void show(double time_s, const EditedLights* edited = nullptr) {
        moment = scene.at(time_s);
        own = moment.lights;
        if (edited != nullptr) moment.lights = edited->at(moment, own);
    }
    std::string text(const std::string& name = "moving.lights.json") const {
        const std::vector<std::byte> bytes = readWholeFile(folder / name);
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }
    static std::string with(std::string_view before, std::string_view after) {
        std::string changed(statedLights);
        return changed.replace(changed.find(before), before.size(), after);
    }
};

TEST(EditedLights, WhatNobodyEditedStaysLetterForLetter) {
    StatedLights stated;
    EditedLights edited(stated.scene, stated.file);
    edited.edit(stated.own, stated.moment, stated.own);
    edited.save(stated.file);
    EXPECT_EQ(stated.text(), statedLights);
    const std::vector<Light> shown = edited.at(stated.moment, stated.own);
    for (std::size_t i = 0; i < shown.size(); ++i)
        EXPECT_EQ(shown[i].shape.worldFromLight, stated.own[i].shape.worldFromLight);

    // One key of one light, in two steps as a drag makes them.
    std::vector<Light> lights = shown;
    stated.moment.lights = shown;
    for (const float width_m : {1.5f, 2.5f}) {
        lights[1].shape.width_m = width_m;
        edited.edit(lights, stated.moment, stated.own);
        stated.show(1, &edited);
        lights = stated.moment.lights;
    }
    edited.save(stated.file);
    const std::string light =
        R"({"name": "key", "type": "RectLight", "width": 2.5, "height": 1, "intensity": 300, )"
        R"("translation": [-2, 4.60, 2], "aim": [0, 0, 0]})";
    const std::string before =
        R"({"name": "key",   "type": "RectLight", "width": 1.0, "height": 1, "intensity": 300,
     "translation": [-2, 4.60, 2], "aim": [0, 0, 0]})";
    EXPECT_EQ(stated.text(), StatedLights::with(before, light));
}

TEST(EditedLights, AnEditedLightKeepsItsNodeAndItsMotion) {
    StatedLights stated;
    EditedLights edited(stated.scene, stated.file);
    std::vector<Light> lights = stated.own;
    lights[0].castsShadow = false;
    glm::mat4 matrix = std::bit_cast<glm::mat4>(lights[0].shape.worldFromLight);
    matrix[3] += glm::vec4(0.25f, 0.5f, 0, 0);
    lights[0].shape.worldFromLight = std::bit_cast<Mat4>(matrix);
    edited.edit(lights, stated.moment, stated.own);
    edited.save(stated.folder / "other.lights.json");
    const std::string text = stated.text("other.lights.json");
    EXPECT_NE(text.find(R"("intensity": 1.50e2)"), std::string::npos) << text;
    EXPECT_NE(text.find(R"("normalize": true)"), std::string::npos) << text;
    EXPECT_NE(text.find(R"("node": "bal?")"), std::string::npos) << text;
    EXPECT_EQ(stated.text(), statedLights) << "the scene's own file is as it was";

    Scene again = makeBuiltin("moving");
    applySidecar(again, readSidecar(stated.folder / "other.lights.json"), stated.folder.path());
    for (const double time_s : {1.0, 0.0, 1.7, 3.1}) {
        stated.show(time_s, &edited);
        const std::vector<Light> read = again.at(time_s).lights;
        for (std::size_t i = 0; i < read.size(); ++i) {
            EXPECT_EQ(read[i].shape.worldFromLight, stated.moment.lights[i].shape.worldFromLight)
                << i << " " << time_s;
            EXPECT_EQ(read[i].emission.value, stated.moment.lights[i].emission.value);
            EXPECT_EQ(read[i].castsShadow, stated.moment.lights[i].castsShadow);
        }
        const auto placeOf = [](const Light& light) {
            return glm::vec3(std::bit_cast<glm::mat4>(light.shape.worldFromLight)[3]);
        };
        EXPECT_NEAR(glm::distance(placeOf(read[0]) - placeOf(stated.own[0]), {0.25f, 0.5f, 0}), 0, 1e-5f);
    }
}

TEST(EditedLights, ALightsPicturesGoAlongToAnotherFolder) {
    const TestFolder folder;
    std::filesystem::create_directories(folder / "there");
    std::filesystem::create_directories(folder / "pictures");
    const Image window(4, 4, 3, 0.5f);
    writePng(folder / "pictures/window.png", window);
    writeFileAtomically(
        folder / "a.lights.json",
        std::string_view(R"({"version": 1, "lights": [{"type": "RectLight", "name": "w", "width": 1,
"height": 1, "intensity": 10, "texture:file": "pictures/window.png", "translation": [0, 3, 0]}]})"));
    Scene scene = makeBuiltin("half-plane");
    applySidecar(scene, readSidecar(folder / "a.lights.json"), folder.path());
    SceneMoment moment = scene.at(0);
    EditedLights edited(scene, folder / "a.lights.json");
    std::vector<Light> lights = moment.lights;
    lights[0].castsShadow = false;
    edited.edit(lights, moment, moment.lights);
    edited.save(folder / "there/b.lights.json");
    Scene again = makeBuiltin("half-plane");
    applySidecar(again, readSidecar(folder / "there/b.lights.json"), folder / "there");
    EXPECT_GE(again.at(0).lights.at(0).texture, 0);
    EXPECT_FALSE(again.at(0).lights.at(0).castsShadow);
}

}  // namespace
}  // namespace penumbra::studio::viewer
