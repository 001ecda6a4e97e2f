// SPDX-License-Identifier: Apache-2.0
// The viewer's arithmetic, without a window.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "studio/errors.h"
#include "studio/image/atomic_file.h"
#include "studio/image/image_io.h"
#include "studio/image/test_folder.h"
#include "studio/metrics/false_color.h"
#include "studio/scene/builtin/builtin.h"
#include "studio/scene/light_size.h"
#include "studio/viewer/camera_control.h"
#include "studio/viewer/edited_lights.h"
#include "studio/viewer/gizmo.h"
#include "studio/viewer/light_editing.h"
#include "studio/viewer/numbers.h"
#include "studio/viewer/panels/panels.h"
#include "studio/viewer/progressive_reference.h"
#include "studio/viewer/refining_cost.h"
#include "studio/viewer/settings.h"

namespace penumbra::studio::viewer {
namespace {

constexpr float pi = glm::pi<float>();

/// A camera at (0, 1, 5) that looks level at (0, 1, 0).
CameraControl levelCamera() {
    CameraControl control;
    control.startFrom(camera("level", {0, 1, 5}, {0, 1, 0}), {{-1, 0, -1}, {1, 2, 1}});
    return control;
}

void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-4f) {
    EXPECT_NEAR(glm::distance(a, b), 0, tolerance) << a.x << " " << a.y << " " << a.z;
}

TEST(CameraControl, StartsWhereTheCameraStands) {
    const LookAt look = levelCamera().lookAt();
    expectNear(look.eye, {0, 1, 5});
    expectNear(look.target, {0, 1, 0});
    EXPECT_FLOAT_EQ(glm::radians(look.fov_deg), 0.7f);
}

TEST(CameraControl, OrbitsAroundTheTarget) {
    CameraControl control = levelCamera();
    control.orbit(0.5f * pi, 0);  // the hand goes right, so does what is seen, so the eye goes left
    expectNear(control.lookAt().eye, {-5, 1, 0});
    control.orbit(0, -10);  // no further than nearly straight down
    EXPECT_GT(control.lookAt().eye.y, 5.9f);
    EXPECT_LT(glm::normalize(control.lookAt().eye - control.lookAt().target).y, 0.9999f);
    expectNear(control.lookAt().target, {0, 1, 0});
}

TEST(CameraControl, PansWithTheHand) {
    CameraControl control = levelCamera();
    control.pan(1, 0);  // a picture's height to the right: what is seen moves right, the camera left
    const float height_m = 2 * 5 * std::tan(0.35f);
    expectNear(control.lookAt().target, {-height_m, 1, 0}, 1e-3f);
    control.pan(-1, 1);
    expectNear(control.lookAt().target, {0, 1 - height_m, 0}, 1e-3f);
}

TEST(CameraControl, ZoomsWithoutArriving) {
    CameraControl control = levelCamera();
    control.zoom(1);
    expectNear(control.lookAt().eye, {0, 1, 0.88f * 5});
    for (int i = 0; i < 200; ++i) control.zoom(20);
    EXPECT_NE(control.lookAt().eye, control.lookAt().target);
}

TEST(CameraControl, FliesAndLooksAround) {
    CameraControl control = levelCamera();
    control.fly({0, 0, 2});
    expectNear(control.lookAt().eye, {0, 1, 3});
    control.fly({1, 0.5f, 0});
    expectNear(control.lookAt().eye, {1, 1.5f, 3});
    control.look(0.5f * pi, 0);  // turning the head right looks along +X and moves nobody
    expectNear(control.lookAt().eye, {1, 1.5f, 3});
    expectNear(glm::normalize(control.lookAt().target - control.lookAt().eye), {1, 0, 0});
    control.look(0, 0.25f * pi);
    EXPECT_GT(control.lookAt().target.y, control.lookAt().eye.y);
}

TEST(CameraControl, FramesEverything) {
    for (const float aspect : {0.5f, 1.0f, 2.5f}) {
        CameraControl control = levelCamera();
        const Bounds bounds{{-3, 0, -1}, {7, 2, 4}};
        control.frame(bounds, aspect);
        const CameraView view =
            makeCameraView(lookAtCamera(control.lookAt()), bounds, int(1000 * aspect), 1000);
        const Projection projection(view, {1000 * aspect, 1000});
        for (int i = 0; i < 8; ++i) {
            const auto pixel = projection.pixelOf({i & 1 ? 7 : -3, i & 2 ? 2 : 0, i & 4 ? 4 : -1});
            ASSERT_TRUE(pixel);
            EXPECT_TRUE(pixel->x >= 0 && pixel->x <= 1000 * aspect && pixel->y >= 0 && pixel->y <= 1000);
        }
    }
}

float linear(float v) {
    return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

/// CIE lightness of an sRGB-encoded colour.
float lightnessOf(const std::array<float, 3>& color) {
    const float y = 0.2126f * linear(color[0]) + 0.7152f * linear(color[1]) + 0.0722f * linear(color[2]);
    return y > 0.008856f ? 116 * std::cbrt(y) - 16 : 903.3f * y;
}

TEST(FalseColor, LightnessRisesEvenly) {
    for (int i = 0; i <= 100; ++i) {
        // 0.6: what rounding in the matrices of CIELAB and sRGB leaves.
        EXPECT_NEAR(lightnessOf(orderedColor(float(i) / 100)), 14 + 0.8f * float(i), 0.6f) << i;
    }
}

TEST(FalseColor, HasNoJumpsAndClampsWhatIsOutside) {
    for (int i = 1; i < 256; ++i) {
        const auto a = orderedColor(float(i - 1) / 255), b = orderedColor(float(i) / 255);
        // In linear light: six times the mean step of a channel that runs from none to all; lightness is
        // about a cube root, so that steps grow towards the light end.
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(linear(a[c]), linear(b[c]), 0.024f) << i;
    }
    EXPECT_EQ(orderedColor(-1), orderedColor(0));
    EXPECT_EQ(orderedColor(7), orderedColor(1));
    EXPECT_EQ(orderedColor(std::nanf("")), orderedColor(0));
}

TEST(FalseColor, LevelsAreNice) {
    EXPECT_EQ(niceLevels(0.5f, 20), (std::vector<float>{0.5f, 1, 2, 5, 10, 20}));
    EXPECT_TRUE(niceLevels(0, 1).empty());
    EXPECT_TRUE(niceLevels(2, 1).empty());
    EXPECT_FLOAT_EQ(niceRange(340, false).max, 500);
    EXPECT_FLOAT_EQ(niceRange(340, true).min, 0.5f);
    EXPECT_FLOAT_EQ(niceRange(0, false).max, 1);
    EXPECT_FLOAT_EQ(niceRange(INFINITY, false).max, 1);
}

/// A rect light of 1 x 0.5 m at (0, 2, 0) that shines down, seen from (0, 2, 10) by a camera of 100 pixels a
/// metre.
struct LightOnScreen {
    Light light = rectLight("key", 1, 0.5f, {0, 2, 0}, {0, 0, 0}, 500);
    Bounds scene{{-1, 0, -1}, {1, 1, 1}};
    Camera seen = camera("front", {0, 2, 10}, {0, 2, 0}, 2 * std::atan(0.5f));
    Projection projection{makeCameraView(seen, scene, 1000, 1000), {1000, 1000}};
};

glm::vec3 translationOf(const Light& light) {
    return glm::vec3(std::bit_cast<glm::mat4>(light.shape.worldFromLight)[3]);
}

TEST(Gizmo, ProjectsThereAndBack) {
    const LightOnScreen set;
    const auto pixel = set.projection.pixelOf({1, 3, 0});
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->x, 600, 0.01);
    EXPECT_NEAR(pixel->y, 400, 0.01);
    EXPECT_NEAR(set.projection.pixelsPerMetre({1, 3, 0}), 100, 0.01);
    EXPECT_FALSE(set.projection.pixelOf({0, 2, 11}));
    const Projection::Ray ray = set.projection.rayThrough({600, 400});
    expectNear(ray.origin + ray.direction * (10 / -ray.direction.z), {1, 3, 0}, 1e-3f);
}

TEST(Gizmo, MovesAlongAnArrow) {
    const LightOnScreen set;
    const auto handles = Gizmo::handles(set.light, Gizmo::Mode::move, set.projection, set.scene, 1);
    // The arrow along X starts in the light's middle and goes right.
    EXPECT_EQ(Gizmo::pick(handles, {550, 500}, 1), Gizmo::Axis::x);
    EXPECT_EQ(Gizmo::pick(handles, {500, 450}, 1), Gizmo::Axis::y);
    EXPECT_EQ(Gizmo::pick(handles, {500, 500}, 1), Gizmo::Axis::free);
    EXPECT_FALSE(Gizmo::pick(handles, {700, 300}, 1));

    Gizmo gizmo;
    gizmo.begin(set.light, Gizmo::Mode::move, Gizmo::Axis::x, {550, 500});
    // Seen from the side the nearest place of the arrow to the cursor's ray is not quite the one below it.
    expectNear(translationOf(gizmo.drag({650, 530}, set.projection, set.scene, false)), {1, 2, 0}, 1e-2f);
    expectNear(translationOf(gizmo.drag({657, 530}, set.projection, set.scene, true)), {1.1f, 2, 0}, 1e-3f);
    gizmo.begin(set.light, Gizmo::Mode::move, Gizmo::Axis::free, {500, 500});
    expectNear(translationOf(gizmo.drag({600, 400}, set.projection, set.scene, false)), {1, 3, 0}, 1e-3f);
}

TEST(Gizmo, TurnsAboutARing) {
    const LightOnScreen set;
    // Down is the light's -Z, so that its Y axis lies along the camera's line of sight.
    const glm::vec3 axis = std::bit_cast<glm::mat4>(set.light.shape.worldFromLight)[1];
    ASSERT_NEAR(std::abs(axis.z), 1, 1e-4);
    Gizmo gizmo;
    gizmo.begin(set.light, Gizmo::Mode::turn, Gizmo::Axis::y, {558, 500});
    // A quarter turn on the screen, from right to up.
    const Light turned = gizmo.drag({500, 442}, set.projection, set.scene, false);
    const glm::mat4 matrix = std::bit_cast<glm::mat4>(turned.shape.worldFromLight);
    expectNear(glm::vec3(matrix[2]), {-1, 0, 0}, 1e-3f);  // was up
    expectNear(translationOf(turned), {0, 2, 0});
    const Light snapped = gizmo.drag({556, 480}, set.projection, set.scene, true);  // about 20 degrees
    EXPECT_NEAR(std::bit_cast<glm::mat4>(snapped.shape.worldFromLight)[2].y, std::cos(glm::radians(15.0f)),
                1e-3f);
}

TEST(Gizmo, ResizesFromTheEdgeAndKeepsTheLuminance) {
    const LightOnScreen set;
    const auto handles = Gizmo::handles(set.light, Gizmo::Mode::resize, set.projection, set.scene, 1);
    EXPECT_EQ(Gizmo::pick(handles, {565, 500}, 1),
              Gizmo::Axis::x);  // beyond the edge, half a metre to the right
    Gizmo gizmo;
    gizmo.begin(set.light, Gizmo::Mode::resize, Gizmo::Axis::x, {560, 500});
    const Light larger = gizmo.drag({585, 500}, set.projection, set.scene, false);
    EXPECT_NEAR(larger.shape.width_m, 1.5f, 1e-3f);
    EXPECT_EQ(larger.shape.height_m, 0.5f);
    EXPECT_EQ(larger.emission.value, set.light.emission.value);
    const Light none = gizmo.drag({300, 500}, set.projection, set.scene, false);
    EXPECT_EQ(none.shape.width_m, 0);
}

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
        expectNear(placeOf(read[0]) - placeOf(stated.own[0]), {0.25f, 0.5f, 0}, 1e-5f);
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

TEST(LightEditing, BearingsGoThereAndBack) {
    Light light = rectLight("key", 1, 0.5f, {1, 3, 2}, {0, 0, 0}, 700);
    for (const Bearing wanted : {Bearing{30, 50}, {-120, -10}, {200, 90}, {75, -90}}) {
        setBearing(light, wanted);
        const Bearing found = bearingOf(light);
        EXPECT_NEAR(std::remainder(found.azimuth_deg - wanted.azimuth_deg, 360.0f), 0, 0.01f);
        EXPECT_NEAR(found.altitude_deg, wanted.altitude_deg, 0.02f);
        expectNear(glm::vec3(std::bit_cast<glm::mat4>(light.shape.worldFromLight)[3]), {1, 3, 2});
    }
    aimAt(light, {1, 0, 2});
    EXPECT_NEAR(bearingOf(light).altitude_deg, 90, 1e-3f) << "it shines straight down";
    const Light sun = distantLight("sun", 0.01f, {-1, 0, 0}, 1);
    EXPECT_NEAR(bearingOf(sun).azimuth_deg, 90, 1e-3f) << "light that goes to -X comes from +X";
}

TEST(Numbers, HaveNoExponents) {
    EXPECT_EQ(plainNumber(123456.7), "123457");
    EXPECT_EQ(plainNumber(1e6), "1000000");
    EXPECT_EQ(plainNumber(0.00032104), "0.000321");
    EXPECT_EQ(plainNumber(20), "20");
    EXPECT_EQ(plainNumber(0), "0");
    EXPECT_EQ(plainNumber(-0.25), "-0.25");
    EXPECT_EQ(plainFormat(31234.5f), "%.0f");
}

TEST(RefiningCost, CompilingDoesNotCount) {
    RefiningCost cost;
    int probes = 0;
    const auto probe = [&](int) { return ++probes == 1 ? 900.0 : 80.0; };  // the first compiles, too
    cost.drawn(5000);
    EXPECT_TRUE(cost.isWithin(1000, 4, probe));
    EXPECT_EQ(probes, 2);
    EXPECT_FALSE(cost.isWithin(100, 4, probe));
    EXPECT_EQ(probes, 2) << "and is asked no third time";
    cost.drawn(30);
    EXPECT_TRUE(cost.isWithin(1000, 4, probe));
    EXPECT_EQ(probes, 2) << "what is cheap is not measured again";
}

TEST(Settings, ComeBackAsTheyWere) {
    const TestFolder folder;
    Settings settings{.width = 700, .height = 500, .resolutionScale = 0.5f, .technique = "pcss"};
    settings.parameters["pcss"] = {{"search_samples", "9"}};
    settings.presets["pcss"]["coarse"] = {{"filter_samples", "4"}};
    for (int i = 0; i < 12; ++i) settings.addRecent({"scene" + std::to_string(i), ""});
    settings.addRecent({"scene5", "evening.lights.json"});
    settings.addRecent({"scene5", ""});
    settings.bookmarks["scene5"] = {{"View 1", {.eye = {1, 2, 3}, .target = {0, 1, 0}, .fov_deg = 33.3f}}};
    settings.pictureWidth_px = 1920;
    settings.pictureHeight_px = 1080;
    saveSettings(settings, folder / "deep" / "viewer.json");
    const Settings read = loadSettings(folder / "deep" / "viewer.json");
    EXPECT_EQ(read.width, 700);
    EXPECT_EQ(read.resolutionScale, 0.5f);
    EXPECT_EQ(read.technique, "pcss");
    EXPECT_EQ(read.parameters, settings.parameters);
    EXPECT_EQ(read.presets, settings.presets);
    ASSERT_EQ(read.recentFiles.size(), 10u);
    EXPECT_EQ(read.recentFiles, settings.recentFiles);
    EXPECT_EQ(read.recentFiles[0], (RecentFile{"scene5", ""}));
    EXPECT_EQ(read.recentFiles[1], (RecentFile{"scene5", "evening.lights.json"}));
    EXPECT_EQ(read.bookmarks, settings.bookmarks);
    EXPECT_EQ(read.pictureWidth_px, 1920);
}

TEST(Settings, NonsenseIsNoReasonNotToStart) {
    const TestFolder folder;
    for (const char* text : {"", "{", "[1, 2]", R"({"width": "wide"})", R"({"presets": 3})", "null"}) {
        writeFileAtomically(folder / "viewer.json", std::string_view(text));
        EXPECT_EQ(loadSettings(folder / "viewer.json").width, 1280) << text;
    }
    writeFileAtomically(folder / "viewer.json",
                        std::string_view(R"({"width": -5, "resolution_scale": 1e9})"));
    EXPECT_EQ(loadSettings(folder / "viewer.json").width, 320);
    EXPECT_EQ(loadSettings(folder / "viewer.json").resolutionScale, 0);
}

TEST(Percentiles, OfAHundredFrames) {
    std::vector<float> times;
    for (int i = 0; i < 100; ++i) times.push_back(float(99 - i));
    const Percentiles found = percentilesOf(times);
    EXPECT_EQ(found.p50, 50);
    EXPECT_EQ(found.p95, 95);
    EXPECT_EQ(found.p99, 99);
    EXPECT_EQ(percentilesOf({}).p50, 0);
}

}  // namespace
}  // namespace penumbra::studio::viewer
