// SPDX-License-Identifier: Apache-2.0
// Luminaires, profiles, the sun and colour temperatures, from the file of lights to the scene's moment.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "studio/errors.h"
#include "studio/scene/lights/black_body.h"
#include "studio/scene/lights/sidecar.h"
#include "studio/scene/open_scene.h"
#include "studio/scene/profiles/light_profile.h"
#include "studio/scene/profiles/luminaire.h"

namespace penumbra::studio {
namespace {

namespace fs = std::filesystem;

/// 100 cd in each direction from 60 to `last` degrees; a panel of 0.3 m along C0, 0.6 m along C90.
std::string panel(const std::string& tilt = "NONE", const std::string& last = "90",
                  const std::string& opening = "0.6 0.3 0") {
    return "IESNA:LM-63-2002\nTILT=" + tilt + "\n1 -1 1 2 1 1 2 " + opening + "\n1 1 10\n0 " + last +
           "\n0\n100 100\n";
}

class Luminaires : public ::testing::Test {
  protected:
    void SetUp() override { fs::create_directories(folder / "inner"); }
    void TearDown() override { fs::remove_all(folder); }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder / name) << text;
    }
    /// A built-in scene with one light of these keys.
    Scene sceneWith(const std::string& keys) const {
        write("l.json", "{\"version\": 1, \"lights\": [\n{\"name\": \"lamp\", " + keys + "}]}");
        return openScene("two-boxes", {.lightsFile = folder / "l.json"});
    }
    Light lightOf(const std::string& keys) const { return sceneWith(keys).at(0).lights.at(0); }
    std::string errorOf(const std::string& keys) const {
        try {
            sceneWith(keys);
            return "accepted";
        } catch (const InputError& error) {
            return error.what();
        }
    }
    const fs::path folder = fs::temp_directory_path() / ("penumbra-luminaires-" + std::to_string(getpid()));
};

constexpr const char* down = R"(, "rotation": [-0.7071068, 0, 0, 0.7071068])";

TEST_F(Luminaires, AreWhatTheirFileSays) {
    write("inner/panel.ies", panel());
    const Light light = lightOf(
        std::string(
            R"("type": "LuminaireLight", "file": "inner/panel.ies", "multiplier": 2, "color": [1, 0.5, 0])") +
        down);
    EXPECT_EQ(light.shape.shape, LightShape::rect);
    EXPECT_FLOAT_EQ(light.shape.width_m, 0.3f);   // along X, as C0
    EXPECT_FLOAT_EQ(light.shape.height_m, 0.6f);  // along Y, as C90
    EXPECT_FALSE(light.shape.twoSided);
    EXPECT_EQ(light.emission.unit, Emission::Unit::candela);
    EXPECT_EQ(light.emission.value, glm::vec3(2, 1, 0));
    ASSERT_TRUE(light.profile);
    EXPECT_TRUE(light.profile->isLuminaire);
    EXPECT_NEAR(light.profile->profile->grid.integral(), 200 * std::numbers::pi, 1e-3);

    write("up.ies", panel("NONE", "180"));
    EXPECT_TRUE(lightOf(R"("type": "LuminaireLight", "file": "up.ies")").shape.twoSided);
    write("point.ies", panel("NONE", "180", "0 0 0"));
    EXPECT_EQ(lightOf(R"("type": "LuminaireLight", "file": "point.ies")").shape.radius_m, 0);
    write("box.ies", panel("NONE", "90", "0.6 0.3 0.1"));
    const Scene box = sceneWith(R"("type": "LuminaireLight", "file": "box.ies")");
    ASSERT_EQ(box.warnings.size(), 1u);
    EXPECT_NE(box.warnings[0].find("l.json:2: 'box.ies': its luminous opening, box"), std::string::npos)
        << box.warnings[0];
}

TEST_F(Luminaires, TubesLieAlongC0OrC90) {
    write("c0.ies", panel("NONE", "180", "-0.04 1.2 -0.04"));
    write("c90.ies", panel("NONE", "180", "1.2 -0.04 -0.04"));
    const std::string place = std::string(R"(, "translation": [1, 2, 3], "turn": 30)") + down;
    const Scene scene = sceneWith(R"("type": "LuminaireLight", "file": "c0.ies")" + place);
    EXPECT_TRUE(scene.warnings.empty());
    const Light along = scene.at(0).lights.at(0);
    const Light across = lightOf(R"("type": "LuminaireLight", "file": "c90.ies")" + place);
    for (const Light& light : {along, across}) {
        EXPECT_EQ(light.shape.shape, LightShape::cylinder);
        EXPECT_FLOAT_EQ(light.shape.length_m, 1.2f);
        EXPECT_FLOAT_EQ(light.shape.radius_m, 0.02f);
        EXPECT_EQ(light.shape.worldFromLight.columns[3][1], 2);
        EXPECT_EQ(worldFromLightOf(light), worldFromLightOf(along));
    }
    // Shining down as it does, the luminaire's Y is the world's -Z.
    EXPECT_NEAR(along.shape.worldFromLight.columns[0][0], 1, 1e-6);
    EXPECT_NEAR(across.shape.worldFromLight.columns[0][2], -1, 1e-6);
    EXPECT_NEAR(across.shape.worldFromLight.columns[2][1], 1, 1e-6);
    // C0 stays where it was: 30 degrees off the luminaire's X.
    const auto c0_deg = [](const Light& light) {
        const glm::vec3 c0 = towardsC0(*light.profile);
        EXPECT_NEAR(glm::distance(towardsZenith(*light.profile), glm::vec3(0, 0, 1)), 0, 1e-6);
        return glm::degrees(std::atan2(c0.y, c0.x));
    };
    EXPECT_NEAR(c0_deg(along), 30, 1e-4);
    EXPECT_NEAR(c0_deg(across), -60, 1e-4);

    write("oval.ies", panel("NONE", "180", "-0.04 1.2 -0.09"));
    const Scene oval = sceneWith(R"("type": "LuminaireLight", "file": "oval.ies")");
    ASSERT_EQ(oval.warnings.size(), 1u);
    EXPECT_NE(oval.warnings[0].find("is taken for a round tube"), std::string::npos) << oval.warnings[0];
}

TEST_F(Luminaires, PillarsAreUprightTubes) {
    // 100 cd at 60 degrees and at 120, nothing straight down and up.
    const auto pillar = [](const std::string& downwards) {
        return "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 4 1 1 2 -0.2 -0.2 0.9\n1 1 10\n0 60 120 180\n0\n" +
               downwards + " 100 100 0\n";
    };
    write("pillar.ies", pillar("0.5"));
    const std::string place = std::string(R"(, "translation": [1, 2, 3], "turn": 30)") + down;
    const Scene scene = sceneWith(R"("type": "LuminaireLight", "file": "pillar.ies")" + place);
    EXPECT_TRUE(scene.warnings.empty());
    const Light light = scene.at(0).lights.at(0);
    ASSERT_EQ(light.shape.shape, LightShape::cylinder);
    EXPECT_FLOAT_EQ(light.shape.length_m, 0.9f);
    EXPECT_FLOAT_EQ(light.shape.radius_m, 0.1f);
    EXPECT_NEAR(light.shape.worldFromLight.columns[0][1], 1, 1e-6) << "its length stands";
    EXPECT_NEAR(glm::distance(towardsZenith(*light.profile), glm::vec3(1, 0, 0)), 0, 1e-6);
    // 30 degrees off the luminaire's X, which is the tube's -Z, towards its Y.
    EXPECT_NEAR(glm::distance(towardsC0(*light.profile), glm::vec3(0, 0.5f, -std::sqrt(0.75f))), 0, 1e-6);

    write("downlight.ies", pillar("40"));
    const Scene downlight = sceneWith(R"("type": "LuminaireLight", "file": "downlight.ies")" + place);
    EXPECT_EQ(downlight.at(0).lights.at(0).shape.shape, LightShape::sphere);
    EXPECT_EQ(downlight.warnings.size(), 1u);
}

TEST_F(Luminaires, LoseLightByBeingTilted) {
    write("tilt.ies", panel("INCLUDE\n1 3 0 45 90 1 0.8 0.5"));
    const std::string lamp = R"("type": "LuminaireLight", "file": "tilt.ies")";
    EXPECT_NEAR(lightOf(lamp + down).profile->tilt, 1, 1e-5);
    EXPECT_NEAR(lightOf(lamp).profile->tilt, 0.5, 1e-5);  // shines level
    EXPECT_NEAR(lightOf(lamp + R"(, "rotation": [-0.3826834, 0, 0, 0.9238795])").profile->tilt, 0.8, 1e-5);
}

TEST_F(Luminaires, ProfilesShapeOtherLights) {
    write("panel.ies", panel());
    const std::string disk =
        R"("type": "DiskLight", "radius": 0.2, "intensity": 3, "shaping:ies:file": "panel.ies")";
    const Light light = lightOf(disk);
    EXPECT_EQ(light.shape.shape, LightShape::disk);
    EXPECT_EQ(light.emission.unit, Emission::Unit::nits);
    EXPECT_EQ(light.emission.value, glm::vec3(3));
    EXPECT_FALSE(light.profile->isLuminaire);
    EXPECT_EQ(light.profile->factor, 1);
    const Light normalized = lightOf(
        disk + R"(, "shaping:ies:normalize": true, "shaping:ies:angleScale": 0.5, "shaping:ies:turn": 90)");
    EXPECT_NEAR(normalized.profile->factor, 1 / 50.0, 1e-6);  // 100 cd over half the sphere
    EXPECT_EQ(normalized.profile->angleScale, 0.5f);
    EXPECT_NEAR(normalized.profile->turn_rad, 0.5 * std::numbers::pi, 1e-6);
}

TEST_F(Luminaires, WhatCannotBeReadIsNoLampOfAnotherShape) {
    write("panel.ies", panel());
    write("bad.ies", panel().substr(0, 60));
    write("../penumbra-outside.ies", panel());
    const auto lamp = [](const std::string& file) {
        return R"("type": "LuminaireLight", "file": ")" + file + "\"";
    };
    EXPECT_EQ(errorOf(lamp("panel.ies")), "accepted");
    EXPECT_NE(
        errorOf(lamp("lost.ies")).find("l.json:2: '" + (folder / "lost.ies").string() + "' does not exist"),
        std::string::npos)
        << errorOf(lamp("lost.ies"));
    EXPECT_NE(errorOf(lamp("bad.ies")).find("bad.ies:"), std::string::npos);
    EXPECT_NE(errorOf(lamp("../penumbra-outside.ies")).find("beneath the file's own folder"),
              std::string::npos);
    EXPECT_NE(errorOf(lamp("/etc/lamp.ies")).find("beneath the file's own folder"), std::string::npos);
    EXPECT_NE(errorOf(lamp("panel.txt")).find("must name an LM-63"), std::string::npos);
    EXPECT_NE(errorOf(R"("type": "LuminaireLight")").find("needs a 'file'"), std::string::npos);
    EXPECT_NE(errorOf(lamp("panel.ies") + R"(, "width": 2)").find("unknown key 'width' in LuminaireLight"),
              std::string::npos);
    write("dark.ies", "TILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 10\n0 90\n0\n0 0\n");
    EXPECT_NE(errorOf(R"("type": "RectLight", "shaping:ies:file": "dark.ies", "shaping:ies:normalize": true)")
                  .find("is dark"),
              std::string::npos);
    fs::remove(folder / "../penumbra-outside.ies");
}

TEST_F(Luminaires, WhatIsWrittenReadsBackTheSame) {
    const Sidecar written = parseSidecar(R"({"version": 1, "lights": [
      {"name": "a", "type": "LuminaireLight", "file": "a.ies", "multiplier": 0.7, "turn": 90, "translation": [1, 2, 3]},
      {"name": "b", "type": "SphereLight", "shaping:ies:file": "b.LDT", "shaping:ies:normalize": true,
       "shaping:ies:angleScale": -1.5, "shaping:ies:turn": -30}]})",
                                         "a.json");
    const Sidecar read = parseSidecar(formatSidecar(written), "b.json");
    for (std::size_t i = 0; i < 2; ++i) {
        const SidecarLight &a = written.lights->at(i), &b = read.lights->at(i);
        ASSERT_TRUE(b.profile);
        EXPECT_EQ(a.profile->file, b.profile->file);
        EXPECT_EQ(a.profile->isLuminaire, b.profile->isLuminaire);
        EXPECT_EQ(a.profile->turn_deg, b.profile->turn_deg);
        EXPECT_EQ(a.profile->angleScale, b.profile->angleScale);
        EXPECT_EQ(a.profile->normalize, b.profile->normalize);
        EXPECT_EQ(a.light.emission.value, b.light.emission.value);
        EXPECT_EQ(a.light.emission.unit, b.light.emission.unit);
        EXPECT_EQ(a.parentFromLight[3], b.parentFromLight[3]);
    }
}

TEST_F(Luminaires, TheSunStandsBesideThem) {
    const std::string sun =
        R"("type": "SunLight", "latitude": 51.4779, "longitude": 0, "time": "2026-06-21T12:00Z")";
    const Light light = lightOf(sun);
    EXPECT_EQ(light.shape.shape, LightShape::distant);
    EXPECT_NEAR(light.shape.worldFromLight.columns[2][1], std::sin(61.966 * std::numbers::pi / 180), 1e-4);
    EXPECT_NEAR(lightOf(sun + R"(, "multiplier": 0.5)").emission.value.x, 0.5f * light.emission.value.x,
                1e-3f * light.emission.value.x);
    EXPECT_NE(errorOf(R"("type": "SunLight", "latitude": 51, "longitude": 0, "time": "2026-06-21T00:00Z")")
                  .find("l.json:2: the sun is below the horizon"),
              std::string::npos);
    EXPECT_NE(errorOf(R"("type": "SunLight", "latitude": 91, "longitude": 0, "time": "2026-06-21T12:00Z")")
                  .find("l.json:2: 'latitude' must be between -90 and 90"),
              std::string::npos);
    EXPECT_NE(errorOf(R"("type": "SunLight", "latitude": 51, "longitude": 0, "time": "2026-06-21T12:00")")
                  .find("l.json:2: the time"),
              std::string::npos);
    EXPECT_NE(errorOf(R"("type": "SunLight", "latitude": 51, "longitude": 0)").find("needs a 'time'"),
              std::string::npos);

    const OpenOptions options{.sun =
                                  SunOption{"", parseSunPlace("51.4779,0,2026-06-21T12:00Z", "--sun"), {}}};
    // In place of a scene's own lights, beside those of a file.
    const SceneMoment alone = openScene("two-boxes", options).at(0);
    ASSERT_EQ(alone.lights.size(), 1u);
    EXPECT_EQ(alone.lights[0].name, "sun");
    write("b.json", R"({"version": 1, "lights": [{"name": "sun", "type": "SphereLight"}]})");
    OpenOptions beside = options;
    beside.lightsFile = folder / "b.json";
    const SceneMoment both = openScene("two-boxes", beside).at(0);
    ASSERT_EQ(both.lights.size(), 2u);
    EXPECT_EQ(both.lights[1].name, "sun 2");
}

TEST(BlackBody, IsReddishBelowAndBluishAboveDaylight) {
    for (const float temperature_K : {1000.0f, 2700.0f, 4000.0f, 6500.0f, 10000.0f, 25000.0f}) {
        const glm::vec3 color = blackBodyColor(temperature_K);
        EXPECT_NEAR(glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f)), 1, 1e-5) << temperature_K;
    }
    // D65, Rec. 709's white, lies beside the locus of black bodies near 6500 K.
    const glm::vec3 daylight = blackBodyColor(6504);
    EXPECT_LT(glm::distance(daylight, glm::vec3(1)), 0.12f);
    // x, y of an incandescent lamp (CIE illuminant A, 2856 K) are 0.4476, 0.4074.
    const glm::vec3 lamp = blackBodyColor(2856);
    const glm::mat3 xyzFromRec709(0.4124564f, 0.2126729f, 0.0193339f, 0.3575761f, 0.7151522f, 0.1191920f,
                                  0.1804375f, 0.0721750f, 0.9503041f);
    const glm::vec3 xyz = xyzFromRec709 * lamp;
    EXPECT_NEAR(xyz.x / (xyz.x + xyz.y + xyz.z), 0.4476, 0.004);
    EXPECT_NEAR(xyz.y / (xyz.x + xyz.y + xyz.z), 0.4074, 0.004);
}

TEST(BlackBody, ColoursALight) {
    const auto value = [](const std::string& keys) {
        return parseSidecar(
                   R"({"version": 1, "lights": [{"name": "a", "type": "RectLight", "intensity": 100)" + keys +
                       "}]}",
                   "a.json")
            .lights->at(0)
            .light.emission.value;
    };
    EXPECT_EQ(value(R"(, "colorTemperature": 2700)"), glm::vec3(100));
    EXPECT_EQ(value(R"(, "enableColorTemperature": true, "colorTemperature": 2700)"),
              blackBodyColor(2700) * 100.0f);
}

}  // namespace
}  // namespace penumbra::studio
