// SPDX-License-Identifier: Apache-2.0
// The viewer's arithmetic, without a window.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "studio/errors.h"
#include "studio/image/atomic_file.h"
#include "studio/image/test_folder.h"
#include "studio/metrics/false_color.h"
#include "studio/scene/builtin/builtin.h"
#include "studio/viewer/camera_control.h"
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
