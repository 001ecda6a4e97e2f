// SPDX-License-Identifier: Apache-2.0
// Compressed meshes and pictures: what the encoders of the same libraries write comes back, and what no
// encoder writes is refused.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>
#include <webp/encode.h>

#include <random>

#include "studio/errors.h"
#include "studio/image/test_pictures.h"
#include "studio/scene/gltf/test_fixture.h"
#include "studio/scene/topology.h"

namespace penumbra::studio {
namespace {

using Json = nlohmann::json;

class GltfCompressed : public Gltf {
  protected:
    std::string refusal() {
        try {
            load({.memoryBudget_bytes = 256 << 20}).at(0);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }

    /// Compresses a view in place; the buffer that it names from then on has no data.
    template <class T>
    void compressView(int view, std::size_t stride_bytes, const std::string& mode,
                      const std::vector<T>& bytes) {
        const std::size_t length = gltf_.json["bufferViews"][std::size_t(view)]["byteLength"];
        const int packed = gltf_.addView(bytes);
        Json compressed = gltf_.json["bufferViews"][std::size_t(packed)];
        gltf_.json["bufferViews"].erase(std::size_t(packed));
        compressed["mode"] = mode;
        compressed["byteStride"] = stride_bytes;
        compressed["count"] = length / stride_bytes;
        Json& json = gltf_.json["bufferViews"][std::size_t(view)];
        json = {
            {"buffer", 1}, {"byteLength", length}, {"extensions", {{"EXT_meshopt_compression", compressed}}}};
    }

    Scene loadWithSecondBuffer() {
        Json whole = Json::parse(gltf_.text());
        whole["buffers"].push_back({{"byteLength", 1 << 20}});
        return loadGltf(folder_.write("scene.gltf", whole.dump()));
    }
};

TEST_F(GltfCompressed, MeshoptComesBack) {
    const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.5};
    const std::vector<std::uint16_t> indices = {0, 1, 2, 2, 1, 3};
    Json& primitive = gltf_.addTriangle(positions);
    primitive["indices"] = gltf_.add("SCALAR", indices);

    std::vector<unsigned char> vertexBytes(meshopt_encodeVertexBufferBound(4, 12));
    vertexBytes.resize(
        meshopt_encodeVertexBuffer(vertexBytes.data(), vertexBytes.size(), positions.data(), 4, 12));
    std::vector<unsigned char> indexBytes(meshopt_encodeIndexBufferBound(6, 4));
    const std::vector<unsigned> wide(indices.begin(), indices.end());
    indexBytes.resize(meshopt_encodeIndexBuffer(indexBytes.data(), indexBytes.size(), wide.data(), 6));
    compressView(0, 12, "ATTRIBUTES", vertexBytes);
    compressView(1, 2, "TRIANGLES", indexBytes);
    const Scene scene = loadWithSecondBuffer();
    const Mesh& mesh = scene.meshes.at(0);
    // Triangles may come back turned about, and flat shading gives each its own vertices.
    ASSERT_EQ(mesh.indices.size(), 6u);
    EXPECT_FLOAT_EQ(glm::length(mesh.positions[3] + mesh.positions[4] + mesh.positions[5]),
                    glm::length(glm::vec3(2, 2, 0.5f)));

    Json& compressed = gltf_.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"];
    const Json good = compressed;
    const auto refusedWith = [&](const char* key, const Json& value) {
        compressed = good;
        compressed[key] = value;
        try {
            loadWithSecondBuffer();
        } catch (const InputError& error) {
            return std::string(error.what()).find("/bufferViews/0") != std::string::npos;
        }
        return false;
    };
    EXPECT_TRUE(refusedWith("count", 1ull << 31));
    EXPECT_TRUE(refusedWith("count", 3));
    EXPECT_TRUE(refusedWith("byteStride", 13));
    EXPECT_TRUE(refusedWith("byteStride", 512));
    EXPECT_TRUE(refusedWith("mode", "TRIANGLES"));
    EXPECT_TRUE(refusedWith("mode", "SOMETHING"));
    EXPECT_TRUE(refusedWith("filter", "QUATERNION"));
    EXPECT_TRUE(refusedWith("filter", "SOMETHING"));
    EXPECT_TRUE(refusedWith("byteLength", 5));
    EXPECT_TRUE(refusedWith("byteLength", 1 << 20));
    EXPECT_TRUE(refusedWith("buffer", 1)) << "which has no data";
    // A gigabyte out of some bytes.
    gltf_.json["bufferViews"][0]["byteLength"] = 12ull << 26;
    EXPECT_TRUE(refusedWith("count", 1 << 26));
}

std::vector<std::uint8_t> dracoBytes(int method) {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2);
    const int id = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const float a[] = {0, 0, 0}, b[] = {1, 0, 0}, c[] = {0, 1, 0}, d[] = {1, 1, 0.5f};
    builder.SetAttributeValuesForFace(id, draco::FaceIndex(0), a, b, c);
    builder.SetAttributeValuesForFace(id, draco::FaceIndex(1), c, b, d);
    const auto mesh = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetEncodingMethod(method);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    return {buffer.data(), buffer.data() + buffer.size()};
}

/// A primitive whose data is `bytes`.
void addDraco(TestGltf& gltf, const std::vector<std::uint8_t>& bytes) {
    gltf.json["nodes"] = {{{"mesh", 0}}};
    const int positions = gltf.addAccessor({{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
    const int indices = gltf.addAccessor({{"componentType", 5121}, {"count", 6}, {"type", "SCALAR"}});
    Json primitive = {{"attributes", {{"POSITION", positions}}}, {"indices", indices}};
    primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", gltf.addView(bytes)},
                                                             {"attributes", {{"POSITION", 0}}}};
    gltf.json["meshes"] = {{{"primitives", {primitive}}}};
    gltf.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
}

TEST_F(GltfCompressed, DracoComesBack) {
    for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
        gltf_ = {};
        addDraco(gltf_, dracoBytes(method));
        const Scene scene = load();
        ASSERT_EQ(scene.meshes.size(), 1u);
        EXPECT_EQ(scene.meshes[0].indices.size(), 6u);
        const Bounds bounds = scene.at(0).bounds;
        expectNear(bounds.min, {0, 0, 0});
        expectNear(bounds.max, {1, 1, 0.5});

        Json& extension =
            gltf_.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
        extension["attributes"]["POSITION"] = 7;
        EXPECT_NE(refusal().find("/attributes/POSITION: names nothing"), std::string::npos) << refusal();
        extension["attributes"]["POSITION"] = 0;
        gltf_.json["accessors"][0]["count"] = 5;
        EXPECT_NE(refusal().find("another type or number"), std::string::npos) << refusal();
        gltf_.json["accessors"][1]["count"] = 9;
        EXPECT_NE(refusal().find("has 2 triangles and 4 points or more"), std::string::npos) << refusal();
    }
}

TEST_F(GltfCompressed, DracoThatIsDamagedOrABomb) {
    std::mt19937 random(3);
    for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
        const std::vector<std::uint8_t> good = dracoBytes(method);
        for (std::size_t size = 1; size < good.size() / 2; size += 3) {
            gltf_ = {};
            addDraco(gltf_, {good.begin(), good.begin() + std::ptrdiff_t(size)});
            EXPECT_NE(refusal().find("KHR_draco_mesh_compression"), std::string::npos) << size;
        }
        for (int i = 0; i < 200; ++i) {
            std::vector<std::uint8_t> bad = good;
            for (int k = 0; k < 1 + i % 3; ++k) bad[random() % bad.size()] ^= std::uint8_t(1 << random() % 8);
            gltf_ = {};
            addDraco(gltf_, bad);
            refusal();  // anything but an InputError fails the test
        }
        // Four billion points: the numbers after the header of 11 bytes are of variable length.
        std::vector<std::uint8_t> bomb = good;
        for (std::size_t at : {11u, 16u, 21u}) {
            const std::uint8_t many[] = {0xff, 0xff, 0xff, 0xff, 0x0f};
            bomb.insert(bomb.begin() + std::ptrdiff_t(at), std::begin(many), std::end(many));
            gltf_ = {};
            addDraco(gltf_, bomb);
            EXPECT_NE(refusal().find("KHR_draco_mesh_compression"), std::string::npos);
        }
    }
}

std::string encodedWebp(int width, int height, const std::vector<std::uint8_t>& rgba) {
    std::uint8_t* bytes = nullptr;
    const std::size_t size = WebPEncodeLosslessRGBA(rgba.data(), width, height, width * 4, &bytes);
    const std::string encoded(reinterpret_cast<const char*>(bytes), size);
    WebPFree(bytes);
    return encoded;
}

TEST_F(GltfCompressed, WebpWithAndWithoutASecondSource) {
    const std::vector<std::uint8_t> rgba = {10, 20, 30, 255, 40, 50, 60, 128};
    const std::string webp = encodedWebp(2, 1, rgba);
    gltf_.addTriangle()["material"] = 0;
    gltf_.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    gltf_.json["images"] = {{{"uri", "data:image/webp;base64," + base64(webp)}},
                            {{"uri", "data:image/png;base64," + base64(encodedPng(1, 1, 8, 0, {0}))}}};
    gltf_.json["textures"] = {{{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}}};
    EXPECT_EQ(load().pictures.at(0).rgba, rgba);
    gltf_.json["textures"][0]["source"] = 1;
    EXPECT_EQ(load().pictures.at(0).rgba, rgba);
    // Its header says 16383 x 16383 pixels, the most that WebP can.
    std::string huge = webp;
    huge.replace(21, 4, std::string("\xfe\xff\xff\x0f", 4));
    gltf_.json["images"][0]["uri"] = "data:image/webp;base64," + base64(huge);
    EXPECT_NE(refusal().find("16383 x"), std::string::npos) << refusal();
    gltf_.json["images"][0]["uri"] = "data:image/webp;base64," + base64(webp.substr(0, webp.size() - 6));
    const Scene damaged = load();
    ASSERT_EQ(damaged.warnings.size(), 1u);
    EXPECT_NE(damaged.warnings[0].find("/images/0: left out"), std::string::npos);
}

class GltfCompressedFiles : public ::testing::Test {
  protected:
    void SetUp() override {
        scenes_ = sharedScenes();
        if (!scenes_) GTEST_SKIP() << "the shared scenes are not here; set PENUMBRA_SHARED_SCENES";
    }
    std::optional<std::filesystem::path> scenes_;
};

TEST_F(GltfCompressedFiles, AreAsTheirDescriptionSays) {
    int files = 0;
    for (const std::filesystem::path& file : gltfFiles(*scenes_ / "compressed")) {
        SCOPED_TRACE(file.string());
        ++files;
        const Json expected =
            Json::parse(fileContent(std::filesystem::path(file).replace_extension(".json")));
        const Scene scene = loadGltf(file);
        EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
        const SceneMoment moment = scene.at(0);
        std::size_t triangles = 0;
        int mirrored = 0;
        for (const Instance& instance : moment.instances) {
            triangles += scene.meshes[std::size_t(instance.mesh)].indices.size() / 3;
            mirrored += glm::determinant(glm::mat3(instance.worldFromMesh)) < 0;
        }
        EXPECT_EQ(triangles, expected["triangles_drawn"]);
        EXPECT_EQ(moment.instances.size(), expected["primitives_drawn"]);
        EXPECT_EQ(mirrored, expected["mirrored_parts"]);
        const float tolerance_m = expected["tolerance_m"];
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(moment.bounds.min[axis], expected["bounds_world"]["min"][std::size_t(axis)],
                        tolerance_m);
            EXPECT_NEAR(moment.bounds.max[axis], expected["bounds_world"]["max"][std::size_t(axis)],
                        tolerance_m);
        }
        EXPECT_EQ(scene.animations.size(), expected["animations"].size());
        EXPECT_EQ(moment.lights.size(), expected["lights"].size());
        EXPECT_EQ(moment.cameras.size(), expected["cameras"].size());
        // All but the ground, the first.
        std::size_t open = 0;
        for (std::size_t mesh = 1; mesh < scene.meshes.size(); ++mesh)
            open += analyzeTopology(scene.meshes[mesh].positions, scene.meshes[mesh].indices).boundaryEdges;
        EXPECT_EQ(open, expected["without_ground"]["boundary_edges_exact_all_parts_together"]);
        if (expected.contains("mask")) {
            std::size_t below = 0, sum = 0;
            const std::vector<std::uint8_t>& rgba = scene.pictures.at(0).rgba;
            for (std::size_t i = 3; i < rgba.size(); i += 4) {
                below += rgba[i] < 128;
                sum += rgba[i];
            }
            EXPECT_EQ(below, expected["mask"]["texels_with_alpha_below_128"]);
            EXPECT_EQ(sum, expected["mask"]["alpha_sum"]);
        }
    }
    EXPECT_EQ(files, 4);
}

TEST_F(GltfCompressedFiles, SurviveMutation) {
    const TemporaryFolder folder;
    std::mt19937 random(11);
    int loaded = 0, refused = 0;
    for (const std::filesystem::path& file : gltfFiles(*scenes_ / "compressed")) {
        const std::string original = fileContent(file);
        for (int i = 0; i < 100; ++i) {
            std::string bytes = original;
            for (int k = 0; k < 1 + i % 3; ++k) bytes[random() % bytes.size()] ^= char(1 << random() % 8);
            try {
                loadGltf(folder.write("hostile.glb", bytes)).at(0.3);
                ++loaded;
            } catch (const InputError&) {
                ++refused;
            }
        }
    }
    EXPECT_GT(loaded, 20);
    EXPECT_GT(refused, 20);
}

}  // namespace
}  // namespace penumbra::studio
