// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/lights/sidecar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <numbers>
#include <string>

#include "studio/errors.h"

namespace penumbra::studio {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// The only light of a file that has the keys `body`.
Light onlyLight(const std::string& body) {
    const Sidecar sidecar =
        parseSidecar(R"({"version": 1, "lights": [{"name": "a", )" + body + "}]}", "chair.lights.json");
    return sidecar.lights->at(0).light;
}

std::string errorOf(const std::string& json) {
    try {
        parseSidecar(json, "chair.lights.json");
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

TEST(Sidecar, TheExampleOfTheManual) {
    const Sidecar sidecar = parseSidecar(R"({"version": 1, "lights": [
      {"name": "key", "type": "RectLight", "width": 1.2, "height": 0.6, "intensity": 8000, "color": [1, 0.95, 0.9],
       "texture:file": "window.png", "translation": [0, 4, 0], "rotation": [-0.7071068, 0, 0, 0.7071068]},
      {"name": "bulb", "type": "SphereLight", "radius": 0.1, "intensity": 20000, "node": "Lamp"},
      {"name": "sun", "type": "DistantLight", "angle": 0.53, "intensity": 50000, "rotation": [0, 0, 0, 1]}]})",
                                         "chair.lights.json");
    ASSERT_EQ(sidecar.lights->size(), 3u);
    const SidecarLight& key = sidecar.lights->at(0);
    EXPECT_EQ(key.light.name, "key");
    EXPECT_EQ(key.light.shape.shape, LightShape::rect);
    EXPECT_FLOAT_EQ(key.light.shape.width_m, 1.2f);
    EXPECT_FLOAT_EQ(key.light.shape.height_m, 0.6f);
    EXPECT_EQ(key.light.emission.unit, Emission::Unit::nits);
    EXPECT_FLOAT_EQ(key.light.emission.value.y, 7600);
    EXPECT_EQ(key.textureFile, "window.png");
    EXPECT_EQ(key.textureLine, 3);
    // A quarter turn about -X points the light's -Z down.
    const glm::vec3 emits = -glm::vec3(key.parentFromLight[2]);
    EXPECT_NEAR(emits.y, -1, 1e-6);
    EXPECT_EQ(glm::vec3(key.parentFromLight[3]), glm::vec3(0, 4, 0));
    EXPECT_EQ(sidecar.lights->at(1).node, "Lamp");
    EXPECT_FLOAT_EQ(sidecar.lights->at(1).light.shape.radius_m, 0.1f);
    EXPECT_FLOAT_EQ(sidecar.lights->at(2).light.shape.angle_rad, 0.53f * pi / 180);
}

glm::dvec3 wayOf(const SidecarLight& light) {
    return -glm::dvec3(light.parentFromLight[2]);
}

SidecarLight sidecarLight(const std::string& body) {
    return parseSidecar(R"({"version": 1, "lights": [{"name": "a", )" + body + "}]}", "chair.lights.json")
        .lights->at(0);
}

TEST(Sidecar, LightsShineAtWhatTheyAimAt) {
    const SidecarLight spot =
        sidecarLight(R"("type": "DiskLight", "translation": [1, 4, 2], "aim": [4, 0, 2])");
    EXPECT_NEAR(glm::distance(wayOf(spot), glm::dvec3(0.6, -0.8, 0)), 0, 1e-6);
    EXPECT_NEAR(spot.parentFromLight[0].y, 0, 1e-6) << "X lies level";
    EXPECT_EQ(glm::dvec3(spot.parentFromLight[3]), glm::dvec3(1, 4, 2));
    const SidecarLight down =
        sidecarLight(R"("type": "RectLight", "translation": [1, 4, 2], "aim": [1, 0, 2])");
    EXPECT_NEAR(glm::distance(wayOf(down), glm::dvec3(0, -1, 0)), 0, 1e-6);
}

TEST(Sidecar, DistantLightsStandWhereAzimuthAndAltitudeSay) {
    // From the east, 30 degrees high: it shines to the west and down.
    const SidecarLight sun = sidecarLight(R"("type": "DistantLight", "azimuth": 90, "altitude": 30)");
    EXPECT_NEAR(glm::distance(wayOf(sun), glm::dvec3(-std::sqrt(0.75), -0.5, 0)), 0, 1e-6);
    EXPECT_TRUE(sun.isInWorld);
    // The defaults are those of a light without rotation.
    EXPECT_NEAR(glm::distance(wayOf(sidecarLight(R"("type": "DistantLight", "altitude": 0)")),
                              wayOf(sidecarLight(R"("type": "DistantLight")"))),
                0, 1e-6);
}

TEST(Sidecar, PlacesAreSaidOnce) {
    const auto error = [](const std::string& body) {
        return errorOf(R"({"version": 1, "lights": [{"name": "a", )" + body + "}]}");
    };
    EXPECT_EQ(error(R"("type": "RectLight", "rotation": [0, 0, 0, 1], "aim": [0, 1, 0])"),
              "chair.lights.json:1: 'rotation' and 'aim' say the same: keep one of them");
    EXPECT_EQ(error(R"("type": "DistantLight", "aim": [0, 1, 0], "altitude": 4)"),
              "chair.lights.json:1: 'aim' and 'altitude' say the same: keep one of them");
    EXPECT_EQ(error(R"("type": "RectLight", "node": "a", "below": "b")"),
              "chair.lights.json:1: 'node' and 'below' say the same: keep one of them");
    EXPECT_EQ(error(R"("type": "RectLight", "translation": [1, 2, 3], "aim": [1, 2, 3])"),
              "chair.lights.json:1: 'aim' must be a point other than the light's own place");
    EXPECT_NE(error(R"("type": "DistantLight", "below": "b")").find("unknown key 'below'"),
              std::string::npos);
}

TEST(Sidecar, TubesAreUsdLuxsCylinders) {
    const Light plain = onlyLight(R"("type": "CylinderLight")");
    EXPECT_EQ(plain.shape.shape, LightShape::cylinder);
    EXPECT_EQ(plain.shape.length_m, 1);
    EXPECT_EQ(plain.shape.radius_m, 0.5f);
    EXPECT_EQ(plain.emission.value.x, 1);
    const Light normalized = onlyLight(
        R"("type": "CylinderLight", "length": 1.2, "radius": 0.013, "intensity": 300, "normalize": true)");
    EXPECT_NEAR(normalized.emission.value.x, 300 / (2 * pi * 0.013f * 1.2f), 1e-2);
    EXPECT_EQ(normalized.emission.unit, Emission::Unit::nits);
    // Of no size: candela, and with normalize those that ever smaller ones tend to, across.
    for (const char* size : {R"("length": 0)", R"("radius": 0)"}) {
        const std::string body = std::string(R"("type": "CylinderLight", "intensity": 300, )") + size;
        EXPECT_EQ(onlyLight(body).emission.unit, Emission::Unit::candela);
        EXPECT_EQ(onlyLight(body).emission.value.x, 300);
        EXPECT_NEAR(onlyLight(body + R"(, "normalize": true)").emission.value.x, 300 / pi, 1e-3);
    }
    EXPECT_NE(errorOf(R"({"version": 1, "lights": [{"name": "a", "type": "CylinderLight", "width": 1}]})")
                  .find("unknown key 'width' in CylinderLight"),
              std::string::npos);
}

TEST(Sidecar, WattsAreThoseOfAProgramAndItsVersion) {
    const auto nits = [](const std::string& body) { return onlyLight(body).emission.value.x; };
    const std::string rect = R"("type": "RectLight", "width": 2, "height": 0.5, "watts": 60, "program": )";
    EXPECT_NEAR(nits(rect + R"("Blender 4.2")"), 683 * 60 / pi, 1e-1);
    EXPECT_NEAR(nits(rect + R"("blender v3.6.5")"), 683 * 60 / 4.0f, 1e-1);
    EXPECT_NEAR(nits(rect + R"("Blender 5.0", "exposure": 1, "color": [0.5, 1, 1])"), 683 * 60 / pi, 1e-1);
    EXPECT_NEAR(nits(R"("type": "DiskLight", "radius": 0.5, "watts": 60, "program": "Blender 2.93")"),
                683 * 60 / pi, 1e-1);
    // Points: 1 / (4 pi) of it in each direction, in all versions.
    const Light point =
        onlyLight(R"("type": "SphereLight", "radius": 0, "watts": 60, "program": "Blender 3.0")");
    EXPECT_EQ(point.emission.unit, Emission::Unit::candela);
    EXPECT_NEAR(point.emission.value.x, 683 * 60 / (4 * pi), 1e-1);
    EXPECT_NEAR(nits(R"("type": "SphereLight", "radius": 0.1, "watts": 60, "program": "Blender 4.0")"),
                683 * 60 / (4 * pi * pi * 0.01f), 1);

    const auto error = [](const std::string& body) {
        return errorOf(R"({"version": 1, "lights": [{"name": "a", )" + body + "}]}");
    };
    EXPECT_NE(
        error(R"("type": "RectLight", "watts": 60)").find("chair.lights.json:1: 'watts' need the 'program'"),
        std::string::npos);
    EXPECT_NE(error(R"("type": "RectLight", "program": "Blender 4.2")").find("without 'watts'"),
              std::string::npos);
    for (const char* other : {"Blender", "Cinema 4D", "4.2", ""})
        EXPECT_TRUE(error(rect + "\"" + other + "\"").starts_with("chair.lights.json:1: ")) << other;
    EXPECT_NE(error(rect + R"("Blender 4.2", "intensity": 3)").find("say the same"), std::string::npos);
    EXPECT_NE(error(R"("type": "DistantLight", "watts": 3, "program": "Blender 4.2")").find("unknown key"),
              std::string::npos);
    EXPECT_NE(error(R"("type": "RectLight", "width": 0, "watts": 3, "program": "Blender 4.2")").find("area"),
              std::string::npos);
}

TEST(Sidecar, WhatIsWrittenReadsBackTheSame) {
    const Sidecar written =
        parseSidecar(R"({"version": 1, "unit": "in", "up": "z", "glass": "tinted", "lights": [
      {"name": "a \"quoted\" \u00e9", "type": "RectLight", "width": 1.1, "height": 0, "intensity": 8123.7,
       "color": [0.1, 0.7, 0.3], "texture:file": "window.png", "translation": [0.1, 4, -1e-7], "twoSided": true,
       "rotation": [-0.7071068, 0, 0, 0.7071068]},
      {"name": "b", "type": "DiskLight", "radius": 0.3, "exposure": 3.3, "shaping:cone:angle": 30,
       "shaping:cone:softness": 0.25, "shadow:enable": false},
      {"name": "c", "type": "SphereLight", "radius": 0, "intensity": 0, "node": "Lamp"},
      {"name": "d", "type": "DistantLight", "angle": 0.53}],
      "nodes": {"Sky": {"casts": false}, "Floor": {"casts": true, "receives": false}},
      "materials": {"Glass*": {"casts": false}}})",
                     "a.lights.json");
    const std::string text = formatSidecar(written);
    const Sidecar read = parseSidecar(text, "b.lights.json");
    EXPECT_EQ(read.reading.unit_m, 0.0254);
    EXPECT_EQ(read.reading.up, UpAxis::z);
    EXPECT_EQ(read.reading.glass, Glass::tinted);
    ASSERT_EQ(read.lights->size(), written.lights->size());
    for (std::size_t i = 0; i < read.lights->size(); ++i) {
        const SidecarLight &a = (*written.lights)[i], &b = (*read.lights)[i];
        EXPECT_EQ(a.light.name, b.light.name);
        EXPECT_EQ(a.light.shape.shape, b.light.shape.shape);
        EXPECT_EQ(a.light.shape.width_m, b.light.shape.width_m);
        EXPECT_EQ(a.light.shape.height_m, b.light.shape.height_m);
        EXPECT_EQ(a.light.shape.radius_m, b.light.shape.radius_m);
        EXPECT_FLOAT_EQ(a.light.shape.angle_rad, b.light.shape.angle_rad);
        EXPECT_EQ(a.light.shape.twoSided, b.light.shape.twoSided);
        EXPECT_EQ(a.light.emission.unit, b.light.emission.unit);
        EXPECT_EQ(a.light.emission.value, b.light.emission.value);  // bit for bit
        EXPECT_EQ(a.light.castsShadow, b.light.castsShadow);
        ASSERT_EQ(a.light.cone_rad.has_value(), b.light.cone_rad.has_value());
        for (std::size_t k = 0; a.light.cone_rad && k < 2; ++k) {
            EXPECT_FLOAT_EQ((*a.light.cone_rad)[k], (*b.light.cone_rad)[k]);
        }
        EXPECT_EQ(a.parentFromLight[3], b.parentFromLight[3]);
        for (int column = 0; column < 3; ++column) {
            // A quaternion of six digits and back: 1e-6.
            EXPECT_NEAR(glm::distance(a.parentFromLight[column], b.parentFromLight[column]), 0, 1e-6);
        }
        EXPECT_EQ(a.node, b.node);
        EXPECT_EQ(a.textureFile, b.textureFile);
    }
    ASSERT_EQ(read.surfaces.nodes.size(), 2u);
    EXPECT_EQ(read.surfaces.nodes[0].name, "Sky");
    EXPECT_EQ(read.surfaces.nodes[0].casts, false);
    EXPECT_FALSE(read.surfaces.nodes[0].receives);
    EXPECT_EQ(read.surfaces.nodes[1].receives, false);
    ASSERT_EQ(read.surfaces.materials.size(), 1u);
    EXPECT_EQ(read.surfaces.materials[0].name, "Glass*");
    EXPECT_EQ(read.surfaces.materials[0].casts, false);
    // A sidecar that says nothing about lights still says nothing.
    const Sidecar silent = parseSidecar(formatSidecar({.fileName = "c"}), "c");
    EXPECT_FALSE(silent.lights);
    EXPECT_TRUE(silent.reading.saysNothing());
    EXPECT_TRUE(parseSidecar(formatSidecar({.lights = std::vector<SidecarLight>()}), "c").lights->empty());
}

TEST(Sidecar, DefaultsAreThoseOfUsdLux) {
    const Light rect = onlyLight(R"("type": "RectLight")");
    EXPECT_EQ(rect.shape.width_m, 1);
    EXPECT_EQ(rect.shape.height_m, 1);
    EXPECT_EQ(rect.emission.value, glm::vec3(1));
    EXPECT_FALSE(rect.shape.twoSided);
    EXPECT_TRUE(rect.castsShadow);
    EXPECT_FALSE(rect.cone_rad);
    EXPECT_EQ(onlyLight(R"("type": "DiskLight")").shape.radius_m, 0.5f);
    EXPECT_EQ(onlyLight(R"("type": "SphereLight")").shape.radius_m, 0.5f);
    const Light distant = onlyLight(R"("type": "DistantLight")");
    EXPECT_FLOAT_EQ(distant.shape.angle_rad, 0.53f * pi / 180);
    EXPECT_EQ(distant.emission.value, glm::vec3(50000));
}

TEST(Sidecar, ExposureDoubles) {
    EXPECT_FLOAT_EQ(onlyLight(R"("type": "RectLight", "intensity": 3, "exposure": 4)").emission.value.x, 48);
    EXPECT_FLOAT_EQ(onlyLight(R"("type": "RectLight", "intensity": 3, "exposure": -1)").emission.value.x,
                    1.5f);
}

TEST(Sidecar, NormalizeDividesByTheArea) {
    const auto value = [](const std::string& body) {
        return onlyLight(body + R"(, "intensity": 60, "normalize": true)").emission.value.x;
    };
    EXPECT_FLOAT_EQ(value(R"("type": "RectLight", "width": 2, "height": 3)"), 10);
    EXPECT_FLOAT_EQ(value(R"("type": "DiskLight", "radius": 2)"), 60 / (4 * pi));
    EXPECT_FLOAT_EQ(value(R"("type": "SphereLight", "radius": 2)"), 60 / (16 * pi));
    EXPECT_FLOAT_EQ(value(R"("type": "DistantLight", "angle": 180)"), 60 / pi);
}

TEST(Sidecar, WithoutSizeIntensityIsCandelaOrLux) {
    const auto emission = [](const std::string& body) {
        return onlyLight(body + R"(, "intensity": 60)").emission;
    };
    for (const std::string body :
         {R"("type": "RectLight", "width": 0)", R"("type": "DiskLight", "radius": 0)",
          R"("type": "SphereLight", "radius": 0)", R"("type": "RectLight", "width": 0, "normalize": true)"}) {
        EXPECT_EQ(emission(body).unit, Emission::Unit::candela) << body;
        EXPECT_EQ(emission(body).value.x, 60) << body;
    }
    EXPECT_EQ(emission(R"("type": "DistantLight", "angle": 0)").unit, Emission::Unit::lux);

    // With `normalize` a sphere's intensity L pi r^2 stays the same however small it is, zero included.
    const float radius_m = 1e-3f;
    const Light small =
        onlyLight(R"("type": "SphereLight", "intensity": 60, "normalize": true, "radius": 0.001)");
    const Light point =
        onlyLight(R"("type": "SphereLight", "intensity": 60, "normalize": true, "radius": 0)");
    EXPECT_NEAR(small.emission.value.x * pi * radius_m * radius_m, point.emission.value.x, 1e-4);
}

TEST(Sidecar, ConesSoftenInwards) {
    const Light spot =
        onlyLight(R"("type": "DiskLight", "shaping:cone:angle": 40, "shaping:cone:softness": 0.25)");
    ASSERT_TRUE(spot.cone_rad);
    EXPECT_FLOAT_EQ((*spot.cone_rad)[0], 30 * pi / 180);
    EXPECT_FLOAT_EQ((*spot.cone_rad)[1], 40 * pi / 180);
}

TEST(Sidecar, FlagsAndNodes) {
    const Light light = onlyLight(R"("type": "RectLight", "twoSided": true, "shadow:enable": false)");
    EXPECT_TRUE(light.shape.twoSided);
    EXPECT_FALSE(light.castsShadow);
    const Sidecar sidecar = parseSidecar(R"({"version": 1, "nodes": {"Sky": {"casts": false}}})", "f");
    EXPECT_FALSE(sidecar.lights) << "no say in the lights";
    ASSERT_EQ(sidecar.surfaces.nodes.size(), 1u);
    EXPECT_EQ(sidecar.surfaces.nodes[0].casts, false);
    EXPECT_FALSE(sidecar.surfaces.nodes[0].receives.has_value());
}

TEST(Sidecar, ErrorsSayWhereAndWhatToDo) {
    const auto withLight = [](const std::string& body) {
        return "{\"version\": 1,\n \"lights\": [\n  {\"name\": \"a\", \"type\": \"SphereLight\",\n   " +
               body + "}]}";
    };
    struct Case {
        std::string json, message;
    };
    const std::string f = "chair.lights.json:";
    const std::vector<Case> cases{
        {R"({"version": 1,
 "unit": "inch"})",
         f + "2: unit 'inch' is none of: mm, cm, m, in, ft"},
        {R"({"version": 1, "up":
 "Z"})",
         f + "2: up 'Z' is none of: y, z"},
        {R"({"version": 1, "glass": "tint"})", f + "1: glass 'tint' is none of: clear, tinted, blocks"},
        {R"({"version": 1, "unit": 0.001})", f + "1: 'unit' must be a string, not number"},
        {R"({"version": 1, "up": null})", f + "1: 'up' must be a string, not null"},
        {R"({"version": 1, "glass": ""})", f + "1: 'glass' must not be empty"},
        {R"({"version": 1, "units": "mm"})", f + "1: unknown key 'units' in the file; did you mean 'unit'?"},
        {withLight("\"radus\": 1"), f + "4: unknown key 'radus' in SphereLight; did you mean 'radius'?"},
        {withLight("\"width\": 1"), f + "4: unknown key 'width' in SphereLight"},
        {withLight("\"radius\":\n\n 1,\r\n\"angle\": 2"), f + "7: unknown key 'angle' in SphereLight"},
        {withLight("\"radius\": \"1\""), f + "4: 'radius' must be a number, not string"},
        {withLight("\"radius\": -1"), f + "4: 'radius' must be at least 0, not -1"},
        {withLight("\"radius\":\n -1\n"), f + "5: 'radius' must be at least 0, not -1"},
        {withLight("\"radius\": 1e39"), f + "4: 'radius' must be a number of ordinary size, not 1e+39"},
        {withLight("\"radius\": 1, \"radius\": 2"), f + "4: key 'radius' is given twice"},
        {withLight("\"color\": [1, 2]"), f + "4: 'color' must have 3 numbers, not 2"},
        {withLight("\"color\": [1,\n 2,\n true]"), f + "6: 'color'[2] must be a number, not boolean"},
        {withLight("\"color\": [1, 2, -3]"), f + "4: 'color'[2] must be at least 0, not -3"},
        {withLight("\"intensity\": 3e38, \"exposure\": 10"),
         f + "3: the light is too strong: intensity x 2^exposure x color must stay below 3.4e38"},
        {withLight("\"exposure\": 101"), f + "4: 'exposure' must be between -100 and 100, not 101"},
        {withLight("\"rotation\": [0, 0, 0, 2]"),
         f + "4: 'rotation' must be a quaternion [x, y, z, w] of length 1, not 2"},
        {withLight("\"rotation\": [0, 0, 0, 0]"),
         f + "4: 'rotation' must be a quaternion [x, y, z, w] of length 1, not 0"},
        {withLight("\"shaping:cone:softness\": 2"),
         f + "4: 'shaping:cone:softness' must be between 0 and 1, not 2"},
        {withLight("\"shadow:enable\": 1"), f + "4: 'shadow:enable' must be true or false, not number"},
        {withLight("\"node\": \"\""), f + "4: 'node' must not be empty"},
        {withLight("\"node\": \"a\\u0007\""), f + "4: 'node' must not contain control characters"},
        {"{\"version\": 1, \"lights\": [\n{\"name\": \"a\"}]}",
         f + "2: a light needs a 'type': one of RectLight, DiskLight, SphereLight, "
             "CylinderLight, DistantLight, "
             "LuminaireLight, SunLight"},
        {"{\"version\": 1, \"lights\": [\n{\"name\": \"a\",\n\"type\": \"Rectlight\"}]}",
         f + "3: unknown type 'Rectlight' of light; did you mean 'RectLight'?"},
        {"{\"version\": 1, \"lights\": [\n{\"name\": \"a\",\n\"type\": \"DomeLight\"}]}",
         f + "3: unknown type 'DomeLight' of light; did you mean 'DiskLight'?"},
        {"{\"version\": 1, \"lights\": [\n{\"type\": \"DiskLight\"}]}", f + "2: a light needs a 'name'"},
        {"{\"version\": 1, \"lights\": [{\"type\": \"DiskLight\", \"name\": \"b\"},\n"
         "{\"type\": \"DiskLight\", \"name\": \"b\"}]}",
         f + "2: two lights are named 'b'"},
        {"{\"version\": 1, \"lights\": [\n7]}", f + "2: 'lights'[0] must be an object, not number"},
        {"{\"version\": 1, \"lights\": {}}", f + "1: 'lights' must be an array, not object"},
        {"{\"version\": 1, \"light\": []}", f + "1: unknown key 'light' in the file; did you mean 'lights'?"},
        {"{\"version\": 1, \"nodes\": {\n\"A\": {\"cast\": true}}}",
         f + "2: unknown key 'cast' in node 'A'; did you mean 'casts'?"},
        {"{\n\"version\": 2}", f + "2: version 2 is not known: this reads version 1"},
        {"{\"lights\": []}", f + "1: the file needs a \"version\": 1"},
        {"[]", f + "1: the file must be an object, not array"},
    };
    for (const Case& c : cases) EXPECT_EQ(errorOf(c.json), c.message) << c.json;
}

TEST(Sidecar, WhatIsNotJsonIsAnError) {
    EXPECT_TRUE(
        errorOf("{\"version\": 1,\n\n nonsense}").starts_with("chair.lights.json:3: not JSON: syntax error"))
        << errorOf("{\"version\": 1,\n\n nonsense}");
    for (const std::string text :
         {"", "{", "{\"version\": 1", "{\"version\": 1}}", "\xff\xfe", "{\"version\": 1e999}"})
        EXPECT_TRUE(errorOf(text).starts_with("chair.lights.json:1: ")) << errorOf(text);
}

TEST(Sidecar, HostileSizesAreRefusedBeforeTheyCost) {
    EXPECT_EQ(errorOf(std::string(1'000'000, '[')), "chair.lights.json:1: nested more than 64 levels deep");
    EXPECT_EQ(errorOf(std::string(5u << 20, ' ')), "chair.lights.json: larger than 4 MiB");
    std::string zeros = "[0";
    for (int i = 0; i < 100'000; ++i) zeros += ",0";
    EXPECT_EQ(errorOf(zeros + "]"), "chair.lights.json:1: more than 20000 values");
    EXPECT_EQ(errorOf("{\"" + std::string(1'000'000, 'a') + "\": 1}").substr(0, 35),
              "chair.lights.json:1: unknown key 'a");
}

// Every prefix, and every single changed byte, of a good file: an InputError or a sidecar, nothing else.
TEST(Sidecar, SurvivesDamage) {
    const std::string good =
        R"({"version": 1, "unit": "mm", "up": "z", "lights": [{"name": "k", "type": "RectLight", "color": [1, 0.9, 0.8],
        "rotation": [0, 0, 0, 1], "texture:file": "a.png"}], "nodes": {"N": {"casts": true}}})";
    const auto parse = [](const std::string& text) {
        try {
            parseSidecar(text, "f");
        } catch (const InputError&) {
        }
    };
    for (std::size_t length = 0; length <= good.size(); ++length)
        EXPECT_NO_THROW(parse(good.substr(0, length)));
    for (std::size_t i = 0; i < good.size(); ++i)
        for (const char c : {'\0', '"', '{', '9', '-', '\n', '\xff'}) {
            std::string damaged = good;
            damaged[i] = c;
            EXPECT_NO_THROW(parse(damaged)) << damaged;
        }
}

}  // namespace
}  // namespace penumbra::studio
