// SPDX-License-Identifier: Apache-2.0
// Known answers: meshes, nodes and scenes of small files that can be worked out by hand.
#include <cmath>

#include "studio/errors.h"
#include "studio/scene/gltf/test_fixture.h"

namespace penumbra::studio {
namespace {

using Json = nlohmann::json;

glm::vec3 transformed(const glm::mat4& m, const glm::vec3& p) {
    return glm::vec3(m * glm::vec4(p, 1));
}

class GltfGeometry : public Gltf {
  protected:
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
};

TEST_F(GltfGeometry, FillsEveryFieldOfATriangle) {
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

TEST_F(GltfGeometry, TriangulatesStripsAndFansInTheOrderOfTheSpecification) {
    Json& primitive = addSixVertices();
    primitive["mode"] = 5;
    EXPECT_EQ(cornerNumbers(load()), (std::vector{0, 1, 2, 1, 3, 2, 2, 3, 4, 3, 5, 4}));
    primitive["mode"] = 6;
    EXPECT_EQ(cornerNumbers(load()), (std::vector{1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5, 0}));
}

TEST_F(GltfGeometry, SkipsPointsLinesAndEmptyPrimitivesWithAWarning) {
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

TEST_F(GltfGeometry, ReadsIndicesOfAllWidths) {
    Json& primitive = addSixVertices();
    primitive["indices"] = gltf_.add<std::uint8_t>("SCALAR", {5, 4, 3});
    EXPECT_EQ(cornerNumbers(load()), (std::vector{5, 4, 3}));
    primitive["indices"] = gltf_.add<std::uint16_t>("SCALAR", {4, 3, 2});
    EXPECT_EQ(cornerNumbers(load()), (std::vector{4, 3, 2}));
    primitive["indices"] = gltf_.add<std::uint32_t>("SCALAR", {3, 2, 1});
    EXPECT_EQ(cornerNumbers(load()), (std::vector{3, 2, 1}));
}

TEST_F(GltfGeometry, ReadsSparseAccessorsWithAndWithoutABase) {
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

TEST_F(GltfGeometry, ReadsInterleavedAttributes) {
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

TEST_F(GltfGeometry, ReadsQuantizedAttributes) {
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

TEST_F(GltfGeometry, ComposesNodesAndKeepsWindingWhereTheyMirror) {
    gltf_.addTriangle();
    gltf_.json["nodes"] = {
        {{"name", "root"}, {"translation", {3, 0, 0}}, {"children", {1}}},
        {{"mesh", 0}, {"scale", {-2, 1, 1}}, {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}}};
    const Scene scene = load();
    const SceneMoment moment = scene.at(0);
    // (1, 0, 0) -> scaled (-2, 0, 0) -> turned 90 degrees (0, -2, 0) -> moved.
    expectNear(transformed(moment.instances.at(0).worldFromMesh, {1, 0, 0}), {3, -2, 0});
    EXPECT_LT(glm::determinant(moment.instances[0].worldFromMesh), 0);
    EXPECT_EQ(scene.meshes[0].indices, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(scene.nodeNames, (std::vector<std::string>{"root", "node 1"}));
    EXPECT_EQ(moment.instances[0].node, 1);
}

TEST_F(GltfGeometry, ReadsNodeMatricesColumnByColumn) {
    gltf_.addTriangle();
    gltf_.json["nodes"][0]["matrix"] = {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1};
    expectNear(transformed(load().at(0).instances.at(0).worldFromMesh, {1, 0, 0}), {1, 3, 3});
}

TEST_F(GltfGeometry, ChoosesTheScene) {
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

TEST_F(GltfGeometry, ReadsCastsAndReceives) {
    gltf_.addTriangle();
    gltf_.json["nodes"][0]["extras"]["penumbra"] = {{"casts", false}, {"receives", true}};
    const SceneMoment moment = load().at(0);
    EXPECT_FALSE(moment.instances.at(0).casts);
    EXPECT_TRUE(moment.instances[0].receives);
    gltf_.json["nodes"][0]["extras"]["penumbra"] = {{"casts", "no"}};
    EXPECT_THROW(load(), InputError);
}

}  // namespace
}  // namespace penumbra::studio
