// SPDX-License-Identifier: Apache-2.0
// Known answers: materials, lights and cameras.
#include <algorithm>
#include <cmath>

#include "studio/errors.h"
#include "studio/image/test_pictures.h"
#include "studio/scene/gltf/test_fixture.h"

namespace penumbra::studio {
namespace {

using Json = nlohmann::json;
using GltfLook = Gltf;

TEST_F(GltfLook, ReadsMaterialsAndBakesTheTextureTransform) {
    Json& primitive = gltf_.addTriangle();
    folder_.write("red.png", encodedPng(2, 1, 8, PNG_COLOR_TYPE_GRAY, {1, 2}));
    gltf_.json["images"] = {{{"uri", "r%65d.png"}}};
    gltf_.json["samplers"] = {{{"magFilter", 9728}, {"wrapS", 33071}}};
    gltf_.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
    gltf_.json["materials"] = {{{"name", "leaf"},
                                {"alphaMode", "MASK"},
                                {"alphaCutoff", 0.25},
                                {"doubleSided", true},
                                {"extensions", {{"KHR_materials_unlit", Json::object()}}}}};
    gltf_.json["materials"][0]["pbrMetallicRoughness"] = {{"baseColorFactor", {1, 0.5, 0.25, 0.75}}};
    Json& info = gltf_.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    // The extension's own example: the lower left quadrant, turned by 90 degrees.
    info = {{"index", 0}, {"texCoord", 0}};
    info["extensions"]["KHR_texture_transform"] = {
        {"offset", {0, 1}}, {"rotation", pi / 2}, {"scale", {0.5, 0.5}}, {"texCoord", 1}};
    primitive["material"] = 0;
    primitive["attributes"]["TEXCOORD_0"] = gltf_.add<float>("VEC2", {9, 9, 9, 9, 9, 9});
    primitive["attributes"]["TEXCOORD_1"] = gltf_.add<float>("VEC2", {0, 0, 1, 0, 0, 1});
    const Scene scene = load();
    const Material& material = scene.materials.at(0);
    EXPECT_EQ(material.name, "leaf");
    EXPECT_EQ(material.alpha, Material::Alpha::mask);
    EXPECT_FLOAT_EQ(material.alphaCutoff, 0.25f);
    EXPECT_TRUE(material.doubleSided && material.unlit);
    EXPECT_FLOAT_EQ(material.baseColor.a, 0.75f);
    const Texture& texture = scene.textures.at(std::size_t(material.baseColorTexture));
    EXPECT_EQ(texture.magFilter, 9728);
    EXPECT_EQ(texture.wrapS, 33071);
    EXPECT_EQ(scene.pictures.at(std::size_t(texture.picture)).width_px, 2);
    const std::vector<glm::vec2>& uvs = scene.meshes.at(0).uvs;
    expectNear(glm::vec3(uvs.at(0), 0), {0, 1, 0});
    expectNear(glm::vec3(uvs.at(1), 0), {0, 0.5, 0});
    expectNear(glm::vec3(uvs.at(2), 0), {0.5, 1, 0});
}

TEST_F(GltfLook, LetsLightThroughGlass) {
    gltf_.addTriangle()["material"] = 0;
    Json& material = gltf_.json["materials"][0];
    const auto casts = [&](Glass glass) { return load({.glass = glass}).at(0).instances.at(0).casts; };
    material = {{"alphaMode", "BLEND"}, {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 1, 1, 0.4}}}}};
    EXPECT_FALSE(casts(Glass::clear));
    EXPECT_TRUE(casts(Glass::blocks));
    const Scene scene = load();
    expectNear(scene.materials.at(0).glass.value(), {0.8, 1, 1});
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_EQ(scene.warnings[0],
              "/materials: 1 pane of glass (alpha below 0.5, or transmission above 0.5) lets light through; "
              "--glass tinted makes them take their share, --glass blocks makes them cast");
    gltf_.json["nodes"][0]["extras"]["penumbra"]["casts"] = true;
    EXPECT_TRUE(casts(Glass::clear)) << "the node's own word";
    gltf_.json["nodes"][0].erase("extras");
    material["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 1, 1, 0.6};
    EXPECT_TRUE(casts(Glass::clear));
    for (const double transmission : {0.4, 0.6}) {
        material = {{"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", transmission}}}}}};
        EXPECT_EQ(casts(Glass::clear), transmission < 0.5);
    }
}

TEST_F(GltfLook, TintedGlassTakesItsShare) {
    gltf_.addTriangle()["material"] = 0;
    Json& material = gltf_.json["materials"][0];
    const auto instance = [&] { return load({.glass = Glass::tinted}).at(0).instances.at(0); };
    const auto made = [&](const char* mode, double alpha, double transmission) {
        material = {{"alphaMode", mode},
                    {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 1, 0.25, alpha}}}}};
        if (transmission >= 0)
            material["extensions"]["KHR_materials_transmission"] = {{"transmissionFactor", transmission}};
    };
    const auto expectPane = [&](const glm::vec3& passes) {
        EXPECT_TRUE(instance().casts);
        expectNear(instance().transmittance, passes);
    };
    // Alpha is how much of it is there: whatever its colour, the rest of the light passes.
    made("BLEND", 0.4, -1);
    expectPane({0.6, 0.6, 0.6});
    const Scene scene = load({.glass = Glass::tinted});
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_EQ(scene.warnings[0],
              "/materials: 1 pane of glass (an alpha below 1, or transmission) takes a share of the light, "
              "in exact "
              "and the reference; --glass clear lets all of it through, --glass blocks none");
    made("BLEND", 0.75, -1);
    expectPane({0.25, 0.25, 0.25});
    EXPECT_FALSE(load({.glass = Glass::tinted}).materials.at(0).glass) << "is drawn as it was";
    // Transmission is tinted by the base colour, and alpha means nothing without BLEND.
    made("OPAQUE", 0.4, 0.8);
    expectPane({0.4, 0.8, 0.2});
    made("BLEND", 0.5, 0.8);
    expectPane({0.7, 0.9, 0.6});
    made("OPAQUE", 1, -1);
    expectPane({0, 0, 0});
    // What is black takes all of it, what is white nothing.
    material["pbrMetallicRoughness"]["baseColorFactor"] = {0, 0, 0, 1};
    material["extensions"]["KHR_materials_transmission"] = {{"transmissionFactor", 1}};
    expectPane({0, 0, 0});
    material["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 1};
    EXPECT_FALSE(instance().casts);
    // The node's own word is all or nothing.
    made("BLEND", 0.4, -1);
    for (const bool casts : {false, true}) {
        gltf_.json["nodes"][0]["extras"]["penumbra"]["casts"] = casts;
        EXPECT_EQ(instance().casts, casts);
        expectNear(instance().transmittance, {0, 0, 0});
    }
}

TEST_F(GltfLook, TakesATexturesBlendForAMask) {
    gltf_.addTriangle()["material"] = 0;
    gltf_.json["textures"] = {{{"source", 0}}};
    Json& material = gltf_.json["materials"][0];
    material["alphaMode"] = "BLEND";
    material["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    for (const int alpha : {60, 200}) {
        gltf_.json["images"] = {
            {{"uri", "data:image/png;base64," + base64(encodedPng(2, 1, 8, PNG_COLOR_TYPE_GRAY_ALPHA,
                                                                  {0, 255, 0, std::uint8_t(alpha)}))}}};
        const Scene scene = load();
        EXPECT_EQ(scene.materials.at(0).alpha == Material::Alpha::mask, alpha < 128);
        EXPECT_FALSE(scene.materials.at(0).glass);
    }
}

TEST_F(GltfLook, GivesPunctualLightsTheirSize) {
    gltf_.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"intensity", 40}, {"color", {1, 0.5, 0}}},
        {{"type", "spot"},
         {"intensity", pi},
         {"spot", {{"innerConeAngle", 0.3}, {"outerConeAngle", 0.6}}},
         {"extras", {{"penumbra", {{"radius", 9}}}}}},
        {{"name", "sun"},
         {"type", "directional"},
         {"intensity", 3},
         {"extras", {{"penumbra", {{"angle", 60}}}}}}};
    gltf_.json["nodes"] = Json::array();
    for (int i = 0; i < 3; ++i)
        gltf_.json["nodes"].push_back(
            {{"name", "lamp"}, {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    gltf_.json["nodes"][1]["extras"]["penumbra"]["radius"] = 0.5;  // the node wins
    gltf_.json["nodes"][1]["translation"] = {1, 2, 3};
    gltf_.json["nodes"][1]["scale"] = {2, 2, 2};
    gltf_.json["scenes"][0]["nodes"] = {0, 1, 2};
    const Scene scene = load();
    const std::vector<Light> lights = scene.at(0).lights;
    ASSERT_EQ(lights.size(), 3u);

    EXPECT_EQ(lights[0].name, "lamp");
    EXPECT_EQ(lights[0].shape.shape, LightShape::sphere);
    EXPECT_EQ(lights[0].emission.unit, Emission::Unit::candela);
    expectNear(lights[0].emission.value, {40, 20, 0});

    EXPECT_EQ(lights[1].shape.shape, LightShape::disk);
    EXPECT_FLOAT_EQ(lights[1].shape.radius_m, 0.5f);
    EXPECT_EQ(lights[1].emission.unit, Emission::Unit::nits);
    EXPECT_FLOAT_EQ(lights[1].emission.value.x, 4);  // pi / (pi 0.5^2)
    EXPECT_FLOAT_EQ(lights[1].cone_rad.value()[1], 0.6f);
    EXPECT_FLOAT_EQ(lights[1].shape.worldFromLight.columns[0][0], 1);  // orthonormal in spite of the scale
    EXPECT_FLOAT_EQ(lights[1].shape.worldFromLight.columns[3][2], 3);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("/nodes/1"), std::string::npos);

    EXPECT_EQ(lights[2].name, "sun");
    EXPECT_EQ(lights[2].shape.shape, LightShape::distant);
    EXPECT_FLOAT_EQ(lights[2].shape.angle_rad, pi / 3);
    EXPECT_FLOAT_EQ(lights[2].emission.value.x, 3 / (pi * 0.25f));
}

TEST_F(GltfLook, ReadsAreaLightsBesideOthers) {
    gltf_.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    gltf_.json["extensions"]["EXT_lights_area"]["lights"] = {{{"type", "rect"},
                                                              {"size", 2},
                                                              {"rect", {{"aspect", 1.5}}},
                                                              {"intensity", 800},
                                                              {"color", {1, 1, 0}}},
                                                             {{"type", "disk"}, {"size", 3}}};
    gltf_.json["nodes"] = {{{"extensions", {{"EXT_lights_area", {{"light", 0}}}}}},
                           {{"extensions", {{"EXT_lights_area", {{"light", 1}}}}}, {"scale", {1, 2, -0.5}}},
                           {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}};
    gltf_.json["scenes"][0]["nodes"] = {0, 1, 2};
    const Scene scene = load();
    const std::vector<Light> lights = scene.at(0).lights;
    ASSERT_EQ(lights.size(), 3u);
    EXPECT_EQ(lights[0].shape.shape, LightShape::rect);
    EXPECT_FLOAT_EQ(lights[0].shape.width_m, 3);
    EXPECT_FLOAT_EQ(lights[0].shape.height_m, 2);
    expectNear(lights[0].emission.value, {800, 800, 0});
    EXPECT_EQ(lights[1].shape.shape, LightShape::disk);
    EXPECT_FLOAT_EQ(lights[1].shape.radius_m, 3) << "twice, by the largest scale of its node";
    EXPECT_FLOAT_EQ(lights[1].emission.value.x, 1000) << "the draft's default";
    EXPECT_EQ(lights[2].shape.shape, LightShape::sphere);
    EXPECT_TRUE(scene.warnings.empty());

    gltf_.json["asset"]["generator"] = "Babylon.js v8.56.2";
    const Scene babylon = load();
    EXPECT_FLOAT_EQ(babylon.at(0).lights[1].emission.value.x, 1);
    ASSERT_EQ(babylon.warnings.size(), 1u);
    EXPECT_NE(babylon.warnings[0].find("leaves out an intensity of 1"), std::string::npos);
}

TEST_F(GltfLook, ReadsSpotsWithAHardEdge) {
    gltf_.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}}};
    gltf_.json["nodes"] = {{{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}};
    Json& spot = gltf_.json["extensions"]["KHR_lights_punctual"]["lights"][0]["spot"];
    // The last as a writer rounds it.
    for (const double angle : {0.5, 1.0471975511965976, 1.5707963267948966, 1.57085}) {
        spot = {{"innerConeAngle", angle}, {"outerConeAngle", angle}};
        const std::array<float, 2> cone_rad = load().at(0).lights.at(0).cone_rad.value();
        EXPECT_EQ(cone_rad[0], cone_rad[1]);
        EXPECT_NEAR(cone_rad[0], std::min(angle, double(pi / 2)), 1e-6);
    }
    spot = {{"innerConeAngle", 0.6}, {"outerConeAngle", 0.5}};
    EXPECT_TRUE(load().at(0).lights.empty());
}

TEST_F(GltfLook, LeavesOutABadLightAndNamesIt) {
    gltf_.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"name", "dark"}, {"intensity", -5}}, {{"type", "point"}, {"range", 3}}};
    for (int i = 0; i < 2; ++i)
        gltf_.json["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    gltf_.json["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = load();
    EXPECT_EQ(scene.at(0).lights.size(), 1u);
    ASSERT_EQ(scene.warnings.size(), 2u);
    EXPECT_NE(scene.warnings[0].find("/nodes/0: light 'dark' is left out"), std::string::npos);
    EXPECT_NE(scene.warnings[1].find("1 of them have a range"), std::string::npos);
}

TEST_F(GltfLook, TellsLightsOfOneNameApart) {
    gltf_.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"name", "Lamp"}},
                                                                 {{"type", "point"}, {"name", "Lamp 2"}}};
    for (const char* name : {"Lamp", "Lamp.001", "Lamp", "other"})
        gltf_.json["nodes"].push_back(
            {{"name", name}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    gltf_.json["nodes"][3]["extensions"]["KHR_lights_punctual"]["light"] = 1;
    gltf_.json["scenes"][0]["nodes"] = {0, 1, 2, 3};
    std::vector<std::string> names;
    for (const Light& light : load().at(0).lights) names.push_back(light.name);
    EXPECT_EQ(names, (std::vector<std::string>{"Lamp", "Lamp.001", "Lamp 3", "Lamp 2"}));
}

TEST_F(GltfLook, HidesNodesWithAllBelowThem) {
    gltf_.addTriangle();
    gltf_.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    gltf_.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
    gltf_.json["nodes"] = {{{"mesh", 0}, {"children", {1, 2}}},
                           {{"mesh", 0}, {"camera", 0}},
                           {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}};
    EXPECT_EQ(load().at(0).instances.size(), 2u);
    gltf_.json["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = false;
    const SceneMoment moment = load().at(0);
    EXPECT_TRUE(moment.instances.empty() && moment.lights.empty());
    EXPECT_EQ(moment.cameras.size(), 1u) << "a camera sees from where nobody sees it";
}

TEST_F(GltfLook, ReadsLuminaires) {
    const std::string profile =
        "IESNA:LM-63-2002\nTILT=INCLUDE\n1 2 0 90 1 0.5\n1 -1 1 2 1 1 2 0.3 0.6 0\n1 1 9\n0 90\n0\n100 100\n";
    gltf_.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    gltf_.json["extensions"]["EXT_lights_ies"]["lights"] = {
        {{"name", "panel"}, {"uri", "data:application/x-ies-lm-63;base64," + base64(profile)}}};
    gltf_.json["nodes"] = {
        {{"extensions", {{"EXT_lights_ies", {{"light", 0}}}}}},
        {{"extensions", {{"EXT_lights_ies", {{"light", 0}, {"multiplier", 2}, {"color", {1, 0.5, 0}}}}}},
         {"rotation", {-0.70710678, 0, 0, 0.70710678}}},
        {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}};
    gltf_.json["scenes"][0]["nodes"] = {0, 1, 2};
    const Scene scene = load();
    const std::vector<Light> lights = scene.at(0).lights;
    ASSERT_EQ(lights.size(), 3u);
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(lights[0].name, "panel");
    EXPECT_EQ(lights[1].name, "panel 2");
    EXPECT_EQ(lights[0].shape.shape, LightShape::rect);
    EXPECT_FLOAT_EQ(lights[0].shape.width_m, 0.6f);
    EXPECT_FLOAT_EQ(lights[0].shape.height_m, 0.3f);
    ASSERT_TRUE(lights[0].profile);
    EXPECT_TRUE(lights[0].profile->isLuminaire);
    EXPECT_FLOAT_EQ(lights[0].profile->tilt, 0.5f);  // shines level
    EXPECT_NEAR(lights[1].profile->tilt, 1, 1e-5);   // and down
    expectNear(lights[1].emission.value, {2, 1, 0});

    const auto& light = gltf_.json["extensions"]["EXT_lights_ies"]["lights"][0];
    const auto errorWith = [&](const char* key, const nlohmann::json& value) {
        const auto before = light;
        gltf_.json["extensions"]["EXT_lights_ies"]["lights"][0][key] = value;
        std::string message = "accepted";
        try {
            load();
        } catch (const InputError& error) {
            message = error.what();
        }
        gltf_.json["extensions"]["EXT_lights_ies"]["lights"][0] = before;
        return message;
    };
    EXPECT_NE(errorWith("uri", "data:application/x-ies-lm-63;base64," + base64(profile.substr(0, 60)))
                  .find("/extensions/EXT_lights_ies/lights/0"),
              std::string::npos);
    EXPECT_NE(errorWith("uri", "../lamp.ies").find("beneath the file's own folder"), std::string::npos);
    EXPECT_NE(errorWith("uri", "lost.ies").find("is not there"), std::string::npos);
    EXPECT_NE(errorWith("bufferView", 0).find("either a uri or a bufferView"), std::string::npos);
}

TEST_F(GltfLook, ReadsCameras) {
    gltf_.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}},
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 3}, {"ymag", 2}, {"znear", 0}, {"zfar", 9}}}}};
    gltf_.json["nodes"] = {{{"camera", 0}, {"scale", {3, 3, 3}}, {"translation", {0, 5, 0}}, {"name", "eye"}},
                           {{"camera", 1}}};
    gltf_.json["scenes"][0]["nodes"] = {0, 1};
    const std::vector<Camera> cameras = load().at(0).cameras;
    ASSERT_EQ(cameras.size(), 2u);
    EXPECT_EQ(cameras[0].name, "eye");
    EXPECT_FLOAT_EQ(cameras[0].yfov_rad, 0.7f);
    EXPECT_FALSE(cameras[0].orthographicHeight_m);
    EXPECT_NEAR(glm::determinant(cameras[0].worldFromCamera), 1, 1e-6);
    EXPECT_FLOAT_EQ(cameras[0].worldFromCamera[3].y, 5);
    EXPECT_FLOAT_EQ(cameras[1].orthographicHeight_m.value(), 4);
}

}  // namespace
}  // namespace penumbra::studio
