// SPDX-License-Identifier: Apache-2.0
// Files that mean harm: whatever they hold, they load or are refused with an InputError.
#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <random>

#include "studio/errors.h"
#include "studio/image/test_pictures.h"
#include "studio/scene/gltf/gltf.h"
#include "studio/scene/gltf/test_gltf.h"

namespace penumbra::studio {
namespace {

using Json = nlohmann::json;

class GltfHostile : public ::testing::Test {
  protected:
    // The message of the InputError that loading throws; empty where the file loads.
    std::string refusal(const std::filesystem::path& file, const GltfOptions& options = {}) {
        try {
            const Scene scene = loadGltf(file, options);
            for (const double time_s : {0.0, 0.37, 1e9}) scene.at(time_s);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
    std::string refusalOf(const std::string& content) {
        return refusal(folder_.write("hostile.gltf", content));
    }
    void expectRefused(const std::string& place) {
        const std::string message = refusalOf(gltf_.text());
        EXPECT_NE(message.find("hostile.gltf: " + place), std::string::npos)
            << "instead of '" << place << "': '" << message << "'";
    }

    // The scene loads, with one warning about this place.
    void expectLeftOut(const std::string& place) {
        const Scene scene = loadGltf(folder_.write("hostile.gltf", gltf_.text()));
        ASSERT_EQ(scene.warnings.size(), 1u);
        EXPECT_NE(scene.warnings[0].find(place + ": left out"), std::string::npos) << scene.warnings[0];
        EXPECT_TRUE(scene.pictures.empty() && scene.textures.empty());
    }

    TemporaryFolder folder_;
    TestGltf gltf_;
};

TEST_F(GltfHostile, DeepNesting) {
    const std::string deep(100000, '[');
    EXPECT_NE(refusalOf(R"({"asset":{"version":"2.0"},"extras":)" + deep).find("nests deeper"),
              std::string::npos);
    EXPECT_NE(refusalOf(deep).find("nests deeper"), std::string::npos);
    gltf_.json["extras"] = std::string(1000, '{');  // within a string it is harmless
    expectRefused("/scenes/0/nodes/0");
}

TEST_F(GltfHostile, NodeGraphs) {
    gltf_.json["nodes"] = {{{"children", {1}}}, {{"children", {2}}}, {{"children", {1}}}};
    expectRefused("/nodes/2/children/0");
    gltf_.json["nodes"] = {Json::object(), {{"children", {2}}}, {{"children", {1}}}};
    expectRefused("/nodes/1: is its own ancestor");
    gltf_.json["nodes"] = {{{"children", {0}}}};
    expectRefused("/nodes/0");

    Json chain = Json::array();
    for (int i = 0; i < 200000; ++i) chain.push_back({{"children", {i + 1}}});
    chain.push_back(Json::object());
    gltf_.json["nodes"] = chain;
    expectRefused("/nodes/1024: the hierarchy is deeper");
}

TEST_F(GltfHostile, CountsAndOffsetsThatWrap) {
    gltf_.addTriangle();
    const TestGltf good = gltf_;
    for (const std::uint64_t count :
         {std::uint64_t(1) << 62, std::uint64_t(1) << 53, std::uint64_t(4), ~std::uint64_t(0)}) {
        gltf_.json["accessors"][0]["count"] = count;
        expectRefused("/accessors/0");
    }
    gltf_ = good;
    for (const std::uint64_t offset : {~std::uint64_t(0) - 35, std::uint64_t(1) << 63, std::uint64_t(4)}) {
        gltf_.json["bufferViews"][0]["byteOffset"] = offset;
        expectRefused("/bufferViews/0");
        gltf_.json["bufferViews"][0]["byteOffset"] = 0;
        gltf_.json["accessors"][0]["byteOffset"] = offset;
        expectRefused("/accessors/0");
        gltf_.json["accessors"][0]["byteOffset"] = 0;
    }
    gltf_.json["accessors"][0]["byteOffset"] = 2;
    expectRefused("/accessors/0: its elements are not aligned");
    gltf_ = good;
    for (const int stride : {-4, 3, 8, 256}) {
        gltf_.json["bufferViews"][0]["byteStride"] = stride;
        EXPECT_NE(refusalOf(gltf_.text()), "") << stride;
    }
    gltf_ = good;
    gltf_.json["bufferViews"][0]["byteLength"] = 4096;
    expectRefused("/bufferViews/0");
}

TEST_F(GltfHostile, IndicesThatReferToNothing) {
    gltf_.addTriangle();
    const TestGltf good = gltf_;
    for (const Json& wrong :
         {Json(-1), Json(7), Json(std::uint64_t(1) << 32), Json(0.5), Json("0"), Json(nullptr)})
        for (const char* place :
             {"/nodes/0/mesh", "/meshes/0/primitives/0/attributes/POSITION", "/accessors/0/bufferView",
              "/bufferViews/0/buffer", "/scenes/0/nodes/0", "/scene"}) {
            gltf_ = good;
            gltf_.json[Json::json_pointer(place)] = wrong;
            expectRefused(place);
        }
    gltf_ = good;
    gltf_.json["meshes"][0]["primitives"][0]["indices"] = gltf_.add<std::uint16_t>("SCALAR", {0, 1, 3});
    expectRefused("/accessors/1: element 2 is 3, but there are 3 vertices");
    gltf_ = good;
    for (const int mode : {-1, 7, 99}) {
        gltf_.json["meshes"][0]["primitives"][0]["mode"] = mode;
        expectRefused("/meshes/0/primitives/0/mode");
    }
}

TEST_F(GltfHostile, AbsurdCountsWithoutData) {
    gltf_.addTriangle();
    gltf_.json["accessors"][0] = {{"componentType", 5126}, {"count", 1ull << 31}, {"type", "VEC3"}};
    EXPECT_NE(refusalOf(gltf_.text()).find("memory"), std::string::npos);
    // One vertex buffer, read again by each of many primitives.
    gltf_.json["accessors"][0]["count"] = 1 << 20;
    gltf_.json["meshes"][0]["primitives"] = Json::array();
    for (int i = 0; i < 1000; ++i)
        gltf_.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}});
    EXPECT_NE(
        refusal(folder_.write("hostile.gltf", gltf_.text()), {.memoryBudget_bytes = 64 << 20}).find("memory"),
        std::string::npos);
}

TEST_F(GltfHostile, ABillionInstances) {
    gltf_.addTriangle();
    gltf_.json["accessors"][0] = {{"componentType", 5126}, {"count", 3 << 20}, {"type", "VEC3"}};
    gltf_.json["nodes"] = Json::array();
    gltf_.json["scenes"][0]["nodes"] = Json::array();
    for (int i = 0; i < 1000; ++i) {
        gltf_.json["nodes"].push_back({{"mesh", 0}});
        gltf_.json["scenes"][0]["nodes"].push_back(i);
    }
    EXPECT_NE(refusalOf(gltf_.text()).find("more vertices are drawn"), std::string::npos);
}

TEST_F(GltfHostile, TwoBillionCopies) {
    gltf_.addTriangle();
    const TestGltf good = gltf_;
    nlohmann::json& copies = gltf_.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"];
    copies = {{"attributes",
               {{"TRANSLATION",
                 gltf_.addAccessor({{"componentType", 5126}, {"count", 1ull << 31}, {"type", "VEC3"}})}}}};
    expectRefused("/nodes/0/extensions/EXT_mesh_gpu_instancing: needs more memory");
    gltf_.json["accessors"].back()["count"] = 1 << 23;
    EXPECT_NE(refusal(folder_.write("hostile.gltf", gltf_.text()), {.memoryBudget_bytes = 256 << 20})
                  .find("memory"),
              std::string::npos);
    copies["attributes"]["SCALE"] = 0;
    expectRefused("/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes/TRANSLATION: has another count");
    copies["attributes"] = Json::object();
    expectRefused("/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes: has no attributes");
    copies["attributes"]["ROTATION"] = gltf_.add<float>("VEC4", {0, 0, 0, 0});
    expectRefused(
        "/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes/ROTATION: element 0 is no rotation");
}

TEST_F(GltfHostile, Numbers) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    for (const float bad : {nan, inf, -inf}) {
        gltf_ = {};
        gltf_.addTriangle({0, 0, 0, 1, bad, 0, 0, 1, 0});
        expectRefused("/accessors/0: component 1 of element 1");
    }
    gltf_ = {};
    gltf_.addTriangle();
    const TestGltf good = gltf_;
    gltf_.json["nodes"][0]["rotation"] = {0, 0, 0, 0};
    expectRefused("/nodes/0/rotation");
    gltf_ = good;
    gltf_.json["nodes"][0]["matrix"] = {1, 0, 0};
    expectRefused("/nodes/0/matrix");
    gltf_ = good;
    gltf_.json["nodes"] = {{{"mesh", 0}, {"scale", {1e30, 1e30, 1e30}}, {"children", {1}}},
                           {{"mesh", 0}, {"scale", {1e30, 1e30, 1e30}}}};
    expectRefused("/nodes/1: its transform overflows");
    gltf_ = {};
    gltf_.addTriangle({1e30f, 1e30f, 0, -1e30f, 0, 0, 0, 1e30f, 0});
    gltf_.json["nodes"][0]["scale"] = {1e30, 1e30, 1e30};
    EXPECT_NE(refusalOf(gltf_.text()).find("/nodes/0: its mesh overflows"), std::string::npos);
}

TEST_F(GltfHostile, SparseAccessors) {
    gltf_.addTriangle();
    const auto sparse = [&](const std::vector<std::uint16_t>& indices, int count) {
        gltf_.json["accessors"][0]["sparse"] = {
            {"count", count},
            {"indices", {{"bufferView", gltf_.addView(indices)}, {"componentType", 5123}}},
            {"values", {{"bufferView", gltf_.addView<float>({1, 1, 1, 2, 2, 2})}}}};
    };
    sparse({0, 3}, 2);
    expectRefused("/accessors/0/sparse/indices");
    sparse({1, 1}, 2);
    expectRefused("/accessors/0/sparse/indices");
    sparse({0, 1}, 4);
    expectRefused("/accessors/0/sparse/count");
    sparse({0, 1, 2}, 3);
    expectRefused("/accessors/0/sparse/values");
}

TEST_F(GltfHostile, SkinsAndAnimations) {
    Json& primitive = gltf_.addTriangle();
    primitive["attributes"]["JOINTS_0"] =
        gltf_.add<std::uint8_t>("VEC4", {0, 0, 0, 0, 9, 0, 0, 0, 0, 0, 0, 0});
    primitive["attributes"]["WEIGHTS_0"] = gltf_.add<float>("VEC4", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    gltf_.json["skins"] = {{{"joints", {0}}}};
    gltf_.json["nodes"][0]["skin"] = 0;
    expectRefused("/nodes/0: its mesh names joint 9");

    gltf_ = {};
    gltf_.addTriangle();
    const int output = gltf_.add<float>("VEC3", {0, 0, 0, 3e38f, 0, 0});
    gltf_.json["animations"] = {
        {{"samplers", {{{"input", gltf_.add<float>("SCALAR", {0, 0})}, {"output", output}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "scale"}}}}}}}};
    expectRefused("/accessors/2: its times must increase");
    gltf_.json["animations"][0]["samplers"][0]["input"] = gltf_.add<float>("SCALAR", {0, 1, 2});
    expectRefused("/animations/0/samplers/0/output");
    // Overflows between its keys, when the scene is long loaded.
    gltf_.json["animations"][0]["samplers"][0] = {
        {"input", gltf_.add<float>("SCALAR", {0, 100})},
        {"output", gltf_.add<float>("VEC3", {0, 0, 0, 1, 1, 1, 3e38f, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0})},
        {"interpolation", "CUBICSPLINE"}};
    const Scene scene = loadGltf(folder_.write("late.gltf", gltf_.text()));
    EXPECT_NO_THROW(scene.at(0));
    EXPECT_THROW(scene.at(50), InputError);
}

TEST_F(GltfHostile, PathsOutOfTheFolder) {
    TemporaryFolder outside;
    outside.write("secret.bin", std::string(36, '\0'));
    std::filesystem::create_symlink(outside.path() / "secret.bin", folder_.path() / "link.bin");
    std::filesystem::create_symlink(outside.path(), folder_.path() / "linked");
    std::filesystem::create_directory(folder_.path() / "folder");
    folder_.write("inside.bin", std::string(36, '\0'));
    std::filesystem::create_symlink("../inside.bin", folder_.path() / "folder" / "back.bin");
    gltf_.addTriangle();
    gltf_.buffer.clear();
    Json& buffer = gltf_.json["buffers"][0];
    buffer["byteLength"] = 36;
    for (const std::string& uri :
         {std::string("../../../../../../etc/passwd"), std::string("/etc/passwd"),
          std::string("%2e%2e/secret.bin"), std::string("a/../../secret.bin"),
          "file://" + (outside.path() / "secret.bin").string(), std::string("http://example.org/a.bin"),
          std::string("link.bin"), std::string("linked/secret.bin"), std::string("folder"),
          std::string("inside.bin%00"), std::string("%"), std::string(""), std::string("."),
          std::string("missing.bin"), std::string("~/x"), std::string("$(touch x)"),
          std::string("data:,short"), std::string("data:;base64,!!!!"), std::string("data:")}) {
        buffer["uri"] = uri;
        expectRefused("/buffers/0");
    }
    for (const std::string uri : {"inside.bin", "./inside.bin", "folder/back.bin", "inside%2Ebin"}) {
        buffer["uri"] = uri;
        EXPECT_EQ(refusalOf(gltf_.text()), "") << uri;
    }
}

TEST_F(GltfHostile, Pictures) {
    Json& primitive = gltf_.addTriangle();
    primitive["material"] = 0;
    gltf_.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    gltf_.json["textures"] = {{{"source", 0}}};
    for (const char* uri :
         {"../../etc/passwd", "/etc/passwd", "file:///etc/passwd", "missing.png", "hostile.gltf"}) {
        gltf_.json["images"] = {{{"uri", uri}}};
        expectLeftOut("/images/0");
    }
    gltf_.json["images"] = {
        {{"uri", "data:image/png;base64," + base64(encodedPng(1, 1, 8, 0, {0}).substr(0, 40))}}};
    expectLeftOut("/images/0");
    // 2^30 pixels in a file of some hundred bytes.
    gltf_.json["images"] = {{{"uri", "data:image/png;base64," + base64(pngThatClaims(1 << 15, 1 << 15))}}};
    expectRefused("/images/0: picture 'image 0' is 32768 x 32768 pixels");
    gltf_.json["images"] = {{{"uri", "x.png"}, {"bufferView", 0}}};
    expectRefused("/images/0");
    gltf_.json["textures"][0]["source"] = 1;
    expectRefused("/textures/0/source");
}

TEST_F(GltfHostile, Containers) {
    gltf_.addTriangle();
    gltf_.json["buffers"] = {{{"byteLength", gltf_.buffer.size()}}};
    std::string json = gltf_.json.dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const auto u32 = [](std::size_t value) {
        const auto v = std::uint32_t(value);
        return std::string(reinterpret_cast<const char*>(&v), 4);
    };
    const std::string glb = "glTF" + u32(2) + u32(28 + json.size() + gltf_.buffer.size()) + u32(json.size()) +
                            "JSON" + json + u32(gltf_.buffer.size()) + std::string("BIN\0", 4) + gltf_.buffer;
    EXPECT_EQ(refusalOf(glb), "");
    for (std::size_t size = 0; size < glb.size(); size += 7)
        EXPECT_NE(refusalOf(glb.substr(0, size)), "") << size;
    for (const std::size_t at : {4u, 8u, 12u, 16u, 20u + unsigned(json.size())}) {
        std::string bad = glb;
        bad.replace(at, 4, "\xff\xff\xff\xff");
        EXPECT_NE(refusalOf(bad), "") << at;
    }
}

TEST_F(GltfHostile, WhatIsNotAGltfFile) {
    EXPECT_NE(refusal(folder_.path() / "missing.gltf").find("cannot be opened"), std::string::npos);
    EXPECT_NE(refusal(folder_.path()).find("not a regular file"), std::string::npos);
    EXPECT_NE(refusal("/dev/zero").find("not a regular file"), std::string::npos);
    for (const char* content :
         {"", "{}", "[]", "null", "\xff\xfe", R"({"asset":{"version":"1.0"}})", "{\"asset\":1}"})
        EXPECT_NE(refusalOf(content), "") << content;
    gltf_.json["extensionsRequired"] = {"ACME_secret_shapes"};
    expectRefused("/extensionsRequired/0");
    gltf_.json["extensionsRequired"] = {"KHR_meshopt_compression"};
    EXPECT_NE(refusalOf(gltf_.text()).find("gltfpack -c"), std::string::npos);
}

// A number of the text becomes another one. Values follow a colon, a bracket or a comma; digits of base64 do
// not.
std::string withOtherNumber(const std::string& text, std::mt19937& random) {
    const auto isNumeric = [](char c) { return (c >= '0' && c <= '9') || c == '-' || c == '.' || c == 'e'; };
    std::vector<std::size_t> starts;
    for (std::size_t i = 1; i < text.size(); ++i)
        if (isNumeric(text[i]) && text[i] != 'e' &&
            std::string(":[, \n").find(text[i - 1]) != std::string::npos)
            starts.push_back(i);
    const std::size_t start = starts.at(random() % starts.size());
    std::size_t end = start;
    while (end < text.size() && isNumeric(text[end])) ++end;
    const char* others[] = {"-1",    "0",  "1", "2", "3", "255", "65536", "4294967296", "4611686018427387904",
                            "1e300", "0.5"};
    return text.substr(0, start) + others[random() % std::size(others)] + text.substr(end);
}

TEST_F(GltfHostile, SurvivesMutation) {
    const auto scenes = sharedScenes();
    if (!scenes) GTEST_SKIP() << "the shared scenes are not here; set PENUMBRA_SHARED_SCENES";
    std::mt19937 random(7);
    int loaded = 0, refused = 0;
    for (const char* name :
         {"own/cube_glb.glb", "own/sparse_no_bufferview.gltf", "own/lights_punctual.gltf",
          "own/quantized_u16_i8.glb", "own/alpha_mask_uv1_texture_transform.glb",
          "RiggedSimple/RiggedSimple.gltf", "SimpleMorph/SimpleMorph.gltf", "Cameras/Cameras.gltf"}) {
        const std::filesystem::path file = *scenes / "conformance" / name;
        for (const auto& entry : std::filesystem::directory_iterator(file.parent_path()))
            if (entry.path().extension() != ".gltf" && entry.path().extension() != ".glb" &&
                entry.is_regular_file())
                std::filesystem::copy_file(entry.path(), folder_.path() / entry.path().filename(),
                                           std::filesystem::copy_options::overwrite_existing);
        const std::string original = fileContent(file);
        for (int i = 0; i < 60; ++i) {
            std::string bytes = original;
            if (i % 2 == 0 && file.extension() == ".gltf")
                bytes = withOtherNumber(bytes, random);
            else
                for (int k = 0; k < 1 + i % 3; ++k) bytes[random() % bytes.size()] ^= char(1 << random() % 8);
            ++(refusalOf(bytes).empty() ? loaded : refused);
        }
    }
    EXPECT_GT(loaded, 20);
    EXPECT_GT(refused, 20);
}

TEST_F(GltfHostile, ValidatorsInvalidFiles) {
    const auto scenes = sharedScenes();
    if (!scenes) GTEST_SKIP() << "the shared scenes are not here; set PENUMBRA_SHARED_SCENES";
    const std::vector<std::filesystem::path> files = gltfFiles(*scenes / "invalid");
    EXPECT_EQ(files.size(), 148u);
    int refused = 0;
    for (const std::filesystem::path& file : files) refused += !refusal(file).empty();
    // The rest is wrong in ways that a renderer does not see: names, targets, bounds, unused pictures.
    EXPECT_GE(refused, 85);
}

}  // namespace
}  // namespace penumbra::studio
