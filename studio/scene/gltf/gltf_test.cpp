// SPDX-License-Identifier: Apache-2.0
// Known answers: small files whose meshes, motion, lights and materials can be worked out by hand.
#include "studio/scene/gltf/gltf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "studio/errors.h"
#include "studio/scene/gltf/test_gltf.h"
#include "studio/scene/gltf/test_pictures.h"

namespace penumbra::studio {
namespace {

using Json = nlohmann::json;
constexpr float pi = std::numbers::pi_v<float>;

void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-5f) {
    EXPECT_LE(glm::length(a - b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

glm::vec3 transformed(const glm::mat4& m, const glm::vec3& p) {
    return glm::vec3(m * glm::vec4(p, 1));
}

class Gltf : public ::testing::Test {
  protected:
    Scene load(const GltfOptions& options = {}) {
        return loadGltf(folder_.write("scene.gltf", gltf_.text()), options);
    }

    // Vertices 0..5, none shared by position.
    Json& addSixVertices() {
        return gltf_.addTriangle({0, 0, 0, 1, 0, 0, 2, 0, 1, 3, 1, 0, 4, 0, 2, 5, 1, 1});
    }
    std::vector<glm::vec3> corners(const Scene& scene) {
        std::vector<glm::vec3> all;
        for (const std::uint32_t index : scene.meshes.at(0).indices)
            all.push_back(scene.meshes[0].positions[index]);
        return all;
    }
    std::vector<int> cornerNumbers(const Scene& scene) {
        std::vector<int> numbers;
        for (const glm::vec3& corner : corners(scene)) numbers.push_back(int(corner.x));
        return numbers;
    }
    // Animates node 0 along `path` at times 0, 1, 2 s.
    void animate(const std::string& path, int output, const std::string& interpolation) {
        const int input = gltf_.add<float>("SCALAR", {0, 1, 2});
        gltf_.json["animations"] = {
            {{"name", "clip"},
             {"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
             {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}}};
    }

    TemporaryFolder folder_;
    TestGltf gltf_;
};

TEST_F(Gltf, FillsEveryFieldOfATriangle) {
    gltf_.addTriangle();
    const Scene scene = load();
    EXPECT_EQ(scene.name, "scene");
    EXPECT_EQ(scene.nodeNames, std::vector<std::string>{"node 0"});
    ASSERT_EQ(scene.meshes.size(), 1u);
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2}));
    for (const glm::vec3& normal : mesh.normals) expectNear(normal, {0, 0, 1});
    EXPECT_EQ(scene.materials.at(std::size_t(mesh.material)).name, "default");
    EXPECT_FALSE(mesh.deforms());

    const SceneMoment moment = scene.at(0);
    ASSERT_EQ(moment.instances.size(), 1u);
    EXPECT_TRUE(moment.instances[0].casts && moment.instances[0].receives);
    EXPECT_EQ(moment.worldFromNode.size(), 1u);
    EXPECT_TRUE(moment.lights.empty() && moment.cameras.empty() && scene.warnings.empty());
    expectNear(moment.bounds.min, {0, 0, 0});
    expectNear(moment.bounds.max, {1, 1, 0});
}

TEST_F(Gltf, TriangulatesStripsAndFansInTheOrderOfTheSpecification) {
    Json& primitive = addSixVertices();
    primitive["mode"] = 5;
    EXPECT_EQ(cornerNumbers(load()), (std::vector{0, 1, 2, 1, 3, 2, 2, 3, 4, 3, 5, 4}));
    primitive["mode"] = 6;
    EXPECT_EQ(cornerNumbers(load()), (std::vector{1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5, 0}));
}

TEST_F(Gltf, SkipsPointsLinesAndEmptyPrimitivesWithAWarning) {
    Json& primitive = addSixVertices();
    for (const int mode : {0, 1, 2, 3}) {
        primitive["mode"] = mode;
        const Scene scene = load();
        EXPECT_TRUE(scene.meshes.empty() && scene.at(0).instances.empty());
        ASSERT_EQ(scene.warnings.size(), 1u);
        EXPECT_NE(scene.warnings[0].find("/meshes/0/primitives/0"), std::string::npos);
    }
    primitive["mode"] = 4;
    primitive["indices"] = gltf_.add<std::uint8_t>("SCALAR", {0, 1});
    EXPECT_EQ(load().warnings.size(), 1u);
}

TEST_F(Gltf, ReadsIndicesOfAllWidths) {
    Json& primitive = addSixVertices();
    primitive["indices"] = gltf_.add<std::uint8_t>("SCALAR", {5, 4, 3});
    EXPECT_EQ(cornerNumbers(load()), (std::vector{5, 4, 3}));
    primitive["indices"] = gltf_.add<std::uint16_t>("SCALAR", {4, 3, 2});
    EXPECT_EQ(cornerNumbers(load()), (std::vector{4, 3, 2}));
    primitive["indices"] = gltf_.add<std::uint32_t>("SCALAR", {3, 2, 1});
    EXPECT_EQ(cornerNumbers(load()), (std::vector{3, 2, 1}));
}

TEST_F(Gltf, ReadsSparseAccessorsWithAndWithoutABase) {
    Json& primitive = gltf_.addTriangle();
    Json& accessor = gltf_.json["accessors"][0];
    accessor["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", gltf_.addView<std::uint16_t>({0, 2})}, {"componentType", 5123}}},
        {"values", {{"bufferView", gltf_.addView<float>({7, 7, 7, 8, 8, 8})}}}};
    std::vector<glm::vec3> positions = corners(load());
    expectNear(positions.at(0), {7, 7, 7});
    expectNear(positions.at(1), {1, 0, 0});
    expectNear(positions.at(2), {8, 8, 8});
    accessor.erase("bufferView");
    positions = corners(load());
    expectNear(positions.at(0), {7, 7, 7});
    expectNear(positions.at(1), {0, 0, 0});

    // Indices, too: 0 0 0 becomes 0 1 2.
    primitive["indices"] = gltf_.addAccessor(
        {{"componentType", 5121},
         {"count", 3},
         {"type", "SCALAR"},
         {"sparse",
          {{"count", 2},
           {"indices", {{"bufferView", gltf_.addView<std::uint8_t>({1, 2})}, {"componentType", 5121}}},
           {"values", {{"bufferView", gltf_.addView<std::uint8_t>({1, 2})}}}}}});
    expectNear(corners(load()).at(2), {8, 8, 8});
}

TEST_F(Gltf, ReadsInterleavedAttributes) {
    Json& primitive = gltf_.addTriangle();
    const int view = gltf_.addView<float>({0, 0, 0, 1, 0, 0, /**/ 2, 0, 0, 1, 0, 0, /**/ 0, 2, 0, 1, 0, 0});
    gltf_.json["bufferViews"][std::size_t(view)]["byteStride"] = 24;
    const auto attribute = [&](int offset) {
        return gltf_.addAccessor({{"bufferView", view},
                                  {"byteOffset", offset},
                                  {"componentType", 5126},
                                  {"count", 3},
                                  {"type", "VEC3"}});
    };
    primitive["attributes"] = {{"POSITION", attribute(0)}, {"NORMAL", attribute(12)}};
    const Scene scene = load();
    expectNear(corners(scene).at(1), {2, 0, 0});
    expectNear(corners(scene).at(2), {0, 2, 0});
    for (const glm::vec3& normal : scene.meshes[0].normals) expectNear(normal, {1, 0, 0});
}

TEST_F(Gltf, ReadsQuantizedAttributes) {
    Json& primitive = gltf_.addTriangle();
    gltf_.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    primitive["attributes"] = {
        {"POSITION", gltf_.add<std::int16_t>("VEC3", {-32768, 0, 32767, 0, 32767, 0, 0, 0, 0}, true)}};
    // VEC3 of 16-bit integers is six bytes long: elements must be padded to eight.
    gltf_.json["accessors"].back()["bufferView"] =
        gltf_.addView<std::int16_t>({-32768, 0, 32767, 0, /**/ 0, 32767, 0, 0, /**/ 0, 0, 0, 0});
    gltf_.json["bufferViews"].back()["byteStride"] = 8;
    expectNear(corners(load()).at(0), {-1, 0, 1});  // -32768 is clamped
    expectNear(corners(load()).at(1), {0, 1, 0});
    gltf_.json["accessors"].back()["normalized"] = false;
    expectNear(corners(load()).at(0), {-32768, 0, 32767});
}

TEST_F(Gltf, ComposesNodesAndKeepsWindingWhereTheyMirror) {
    gltf_.addTriangle();
    gltf_.json["nodes"] = {
        {{"name", "root"}, {"translation", {10, 0, 0}}, {"children", {1}}},
        {{"mesh", 0}, {"scale", {-2, 1, 1}}, {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}}};
    const Scene scene = load();
    const SceneMoment moment = scene.at(0);
    // (1, 0, 0) -> scaled (-2, 0, 0) -> turned 90 degrees (0, -2, 0) -> moved.
    expectNear(transformed(moment.instances.at(0).worldFromMesh, {1, 0, 0}), {10, -2, 0});
    EXPECT_LT(glm::determinant(moment.instances[0].worldFromMesh), 0);
    EXPECT_EQ(scene.meshes[0].indices, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(scene.nodeNames, (std::vector<std::string>{"root", "node 1"}));
    EXPECT_EQ(moment.instances[0].node, 1);
}

TEST_F(Gltf, ReadsNodeMatricesColumnByColumn) {
    gltf_.addTriangle();
    gltf_.json["nodes"][0]["matrix"] = {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1};
    expectNear(transformed(load().at(0).instances.at(0).worldFromMesh, {1, 0, 0}), {5, 7, 7});
}

TEST_F(Gltf, ChoosesTheScene) {
    gltf_.addTriangle();
    gltf_.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {5, 0, 0}}}, {{"mesh", 0}}};
    gltf_.json["scenes"] = {{{"nodes", {0}}, {"name", "first"}}, {{"nodes", {1, 2}}}};
    EXPECT_EQ(load().at(0).instances.size(), 1u);
    EXPECT_EQ(load().name, "first");
    EXPECT_EQ(load({.scene = 1}).at(0).instances.size(), 2u);
    EXPECT_EQ(load().at(0).worldFromNode.size(), 3u);
    gltf_.json.erase("scene");
    EXPECT_EQ(load().at(0).instances.size(), 1u);
    gltf_.json.erase("scenes");
    EXPECT_EQ(load().at(0).instances.size(), 3u);
    EXPECT_EQ(load().warnings.size(), 1u);
    EXPECT_THROW(load({.scene = 1}), InputError);
}

TEST_F(Gltf, ReadsCastsAndReceives) {
    gltf_.addTriangle();
    gltf_.json["nodes"][0]["extras"]["penumbra"] = {{"casts", false}, {"receives", true}};
    const SceneMoment moment = load().at(0);
    EXPECT_FALSE(moment.instances.at(0).casts);
    EXPECT_TRUE(moment.instances[0].receives);
    gltf_.json["nodes"][0]["extras"]["penumbra"] = {{"casts", "no"}};
    EXPECT_THROW(load(), InputError);
}

TEST_F(Gltf, InterpolatesStepLinearAndCubic) {
    gltf_.addTriangle();
    const auto x = [&](double time_s) { return load().at(time_s).worldFromNode[0][3].x; };
    const int keys = gltf_.add<float>("VEC3", {0, 0, 0, 4, 0, 0, 6, 0, 0});
    animate("translation", keys, "STEP");
    EXPECT_FLOAT_EQ(x(0.75), 0);
    EXPECT_FLOAT_EQ(x(1.0), 4);
    animate("translation", keys, "LINEAR");
    EXPECT_FLOAT_EQ(x(0.75), 3);
    EXPECT_FLOAT_EQ(x(1.5), 5);
    EXPECT_FLOAT_EQ(x(2.25), 1);  // looped
    EXPECT_FLOAT_EQ(x(-0.5), 5);  // backwards
    // in-tangent, value, out-tangent; on [0, 1]: values 0, 4, out-tangent 8, in-tangent 0. At t = 0.5 the
    // Hermite weights are 0.5, 0.125, 0.5, -0.125: 2 + 1.
    animate("translation", gltf_.add<float>("VEC3", {0, 0, 0, 0, 0,      0, 8, 0, 0, /**/ 0, 0, 0, 4, 0,
                                                     0, 0, 0, 0, /**/ 0, 0, 0, 6, 0, 0,      0, 0, 0}),
            "CUBICSPLINE");
    EXPECT_FLOAT_EQ(x(0.5), 3);
    EXPECT_FLOAT_EQ(x(1), 4);
    EXPECT_DOUBLE_EQ(load().animations.at(0).duration_s, 2);
    EXPECT_EQ(load().animations[0].name, "clip");
}

TEST_F(Gltf, InterpolatesRotationsOnTheSphere) {
    gltf_.addTriangle();
    // From 0 to 120 degrees about Z, the second key with the other sign: the short way is taken all the same.
    const float s = std::sin(pi / 3), c = std::cos(pi / 3);
    animate("rotation", gltf_.add<float>("VEC4", {0, 0, 0, 1, 0, 0, -s, -c, 0, 0, 0, 1}), "LINEAR");
    const glm::mat4 world = load().at(0.25).worldFromNode[0];  // 30 degrees; a straight line would give 25.66
    EXPECT_NEAR(std::atan2(world[0].y, world[0].x), pi / 6, 1e-5);
}

TEST_F(Gltf, PlaysTheChosenAnimationOrNone) {
    gltf_.addTriangle();
    animate("translation", gltf_.add<float>("VEC3", {1, 0, 0, 1, 0, 0, 1, 0, 0}), "LINEAR");
    gltf_.json["animations"].push_back(gltf_.json["animations"][0]);
    gltf_.json["animations"][1]["samplers"][0]["output"] =
        gltf_.add<float>("VEC3", {2, 0, 0, 2, 0, 0, 2, 0, 0});
    EXPECT_EQ(load().at(0).worldFromNode[0][3].x, 1);
    EXPECT_EQ(load({.animation = 1}).at(0).worldFromNode[0][3].x, 2);
    EXPECT_EQ(load({.animation = -1}).at(0).worldFromNode[0][3].x, 0);
    EXPECT_THROW(load({.animation = 2}), InputError);
}

TEST_F(Gltf, MorphsAtATime) {
    Json& primitive = gltf_.addTriangle();
    primitive["targets"] = {{{"POSITION", gltf_.add<float>("VEC3", {0, 0, 4, 0, 0, 0, 0, 0, 0})}}};
    gltf_.json["meshes"][0]["weights"] = {0.5};
    expectNear(load().at(0).instances.at(0).positions.at(0), {0, 0, 2});
    gltf_.json["nodes"][0]["weights"] = {0.25};
    expectNear(load().at(0).instances.at(0).positions.at(0), {0, 0, 1});
    animate("weights", gltf_.add<float>("SCALAR", {0, 1, 0}), "LINEAR");
    const Scene scene = load();
    EXPECT_TRUE(scene.meshes[0].deforms());
    const Instance instance = scene.at(0.5).instances.at(0);
    expectNear(instance.positions.at(0), {0, 0, 2});
    // Flat: the normal follows the triangle (0,0,2), (1,0,0), (0,1,0).
    expectNear(instance.normals.at(0), glm::normalize(glm::vec3(2, 2, 1)));
    EXPECT_FLOAT_EQ(scene.at(0.5).bounds.max.z, 2);
}

TEST_F(Gltf, SkinsAtATime) {
    Json& primitive = gltf_.addTriangle({0, 0, 0, 1, 0, 0, 1, 1, 0});
    // Vertex 0 on joint 0, vertex 1 half on each, vertex 2 on joint 1.
    primitive["attributes"]["JOINTS_0"] =
        gltf_.add<std::uint8_t>("VEC4", {0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0});
    primitive["attributes"]["WEIGHTS_0"] = gltf_.add<float>("VEC4", {1, 0, 0, 0, .5, .5, 0, 0, 1, 0, 0, 0});
    // Joint 1 is bound at (1, 0, 0); its node slides to y = 4 in two seconds.
    std::vector<float> inverseBind(32, 0.0f);
    for (int i = 0; i < 4; ++i) inverseBind[std::size_t(5 * i)] = inverseBind[std::size_t(16 + 5 * i)] = 1;
    inverseBind[16 + 12] = -1;
    gltf_.json["skins"] = {{{"joints", {1, 0}}, {"inverseBindMatrices", gltf_.add("MAT4", inverseBind)}}};
    gltf_.json["skins"][0]["joints"] = {2, 0};
    gltf_.json["nodes"] = {{{"translation", {1, 0, 0}}},
                           {{"mesh", 0}, {"skin", 0}, {"translation", {100, 100, 100}}},
                           {{"name", "fixed"}}};
    gltf_.json["scenes"][0]["nodes"] = {0, 1, 2};
    animate("translation", gltf_.add<float>("VEC3", {1, 0, 0, 1, 2, 0, 1, 4, 0}), "LINEAR");
    const Instance instance = load().at(1).instances.at(0);
    expectNear(glm::vec3(instance.worldFromMesh[3]),
               {0, 0, 0});  // the node's own transform counts for nothing
    expectNear(instance.positions.at(0), {0, 0, 0});
    expectNear(instance.positions.at(1), {1, 1, 0});
    expectNear(instance.positions.at(2), {1, 3, 0});
}

TEST_F(Gltf, KeepsTheFourLargestInfluencesAndNormalisesThem) {
    Json& primitive = gltf_.addTriangle();
    const std::vector<std::uint8_t> first{0, 1, 2, 3}, second{4, 5, 6, 7};
    const std::vector<float> light{.1f, .05f, .05f, .2f}, heavy{.3f, .3f, 0, 0};
    const auto thrice = [](auto values) {
        auto all = values;
        for (int i = 0; i < 2; ++i) all.insert(all.end(), values.begin(), values.end());
        return all;
    };
    primitive["attributes"]["JOINTS_0"] = gltf_.add("VEC4", thrice(first));
    primitive["attributes"]["WEIGHTS_0"] = gltf_.add("VEC4", thrice(light));
    primitive["attributes"]["JOINTS_1"] = gltf_.add("VEC4", thrice(second));
    primitive["attributes"]["WEIGHTS_1"] = gltf_.add("VEC4", thrice(heavy));
    const Scene scene = load();
    glm::vec4 weights = scene.meshes.at(0).jointWeights.at(0);
    EXPECT_NEAR(weights.x + weights.y + weights.z + weights.w, 1, 1e-6);
    std::array<float, 8> ofJoint{};
    for (int i = 0; i < 4; ++i) ofJoint[scene.meshes[0].joints[0][i]] = weights[i];
    EXPECT_NEAR(ofJoint[4], .3 / .9, 1e-6);
    EXPECT_NEAR(ofJoint[3], .2 / .9, 1e-6);
    EXPECT_EQ(ofJoint[1], 0);
}

TEST_F(Gltf, ReadsMaterialsAndBakesTheTextureTransform) {
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
    gltf_.json["materials"][0]["alphaMode"] = "BLEND";
    EXPECT_EQ(load().materials.at(0).alpha, Material::Alpha::opaque);
    EXPECT_EQ(load().warnings.size(), 1u);
}

TEST_F(Gltf, GivesPunctualLightsTheirSize) {
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

TEST_F(Gltf, PrefersAreaLights) {
    gltf_.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    gltf_.json["extensions"]["EXT_lights_area"]["lights"] = {{{"type", "rect"},
                                                              {"size", 2},
                                                              {"rect", {{"aspect", 1.5}}},
                                                              {"intensity", 800},
                                                              {"color", {1, 1, 0}}},
                                                             {{"type", "disk"}, {"size", 3}}};
    gltf_.json["nodes"] = {{{"extensions", {{"EXT_lights_area", {{"light", 0}}}}}},
                           {{"extensions", {{"EXT_lights_area", {{"light", 1}}}}}},
                           {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}};
    gltf_.json["scenes"][0]["nodes"] = {0, 1, 2};
    const Scene scene = load();
    const std::vector<Light> lights = scene.at(0).lights;
    ASSERT_EQ(lights.size(), 2u);
    EXPECT_EQ(lights[0].shape.shape, LightShape::rect);
    EXPECT_FLOAT_EQ(lights[0].shape.width_m, 3);
    EXPECT_FLOAT_EQ(lights[0].shape.height_m, 2);
    expectNear(lights[0].emission.value, {800, 800, 0});
    EXPECT_EQ(lights[1].shape.shape, LightShape::disk);
    EXPECT_FLOAT_EQ(lights[1].shape.radius_m, 1.5f);
    EXPECT_EQ(scene.warnings.size(), 1u);
}

TEST_F(Gltf, ReadsCameras) {
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
