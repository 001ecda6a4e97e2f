// SPDX-License-Identifier: Apache-2.0
// Real files: every shared scene loads, and those that SCENES.md measures have its triangles and its bounding
// box.
#include <gtest/gtest.h>

#include "studio/errors.h"
#include "studio/scene/gltf/gltf.h"
#include "studio/scene/gltf/test_gltf.h"

namespace penumbra::studio {
namespace {

class GltfScenes : public ::testing::Test {
  protected:
    void SetUp() override {
        scenes_ = sharedScenes();
        if (!scenes_) GTEST_SKIP() << "the shared scenes are not here; set PENUMBRA_SHARED_SCENES";
    }
    std::optional<std::filesystem::path> scenes_;
};

void expectConsistent(const Scene& scene, const SceneMoment& moment) {
    EXPECT_EQ(moment.worldFromNode.size(), scene.nodeNames.size());
    for (const Instance& instance : moment.instances) {
        const Mesh& mesh = scene.meshes.at(std::size_t(instance.mesh));
        ASSERT_LT(std::size_t(instance.node), scene.nodeNames.size());
        ASSERT_LT(std::size_t(mesh.material), scene.materials.size());
        ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
        ASSERT_EQ(instance.positions.size(), mesh.deforms() ? mesh.positions.size() : 0);
        ASSERT_EQ(instance.normals.size(), instance.positions.size());
        const Material& material = scene.materials[std::size_t(mesh.material)];
        const bool isTextured = material.baseColorTexture >= 0 || material.emissionTexture >= 0;
        ASSERT_EQ(mesh.colors.size(), mesh.colors.empty() ? 0 : mesh.positions.size());
        ASSERT_EQ(mesh.uvs.size(), isTextured ? mesh.positions.size() : 0);
        for (const glm::vec3& normal : mesh.normals) ASSERT_NEAR(glm::length(normal), 1, 1e-4);
        for (const glm::vec3& normal : instance.normals) ASSERT_NEAR(glm::length(normal), 1, 1e-4);
    }
}

TEST_F(GltfScenes, AllLoadAndMove) {
    std::size_t count = 0;
    for (const char* folder : {"models", "sponza", "conformance"})
        for (const std::filesystem::path& file : gltfFiles(*scenes_ / folder)) {
            const std::string name = file.filename().string();
            SCOPED_TRACE(file.string());
            // These require an extension that nobody has, or a glTF that does not exist yet.
            if (name == "unused_required_unknown_extension.gltf" || name == "Compatibility_04.gltf" ||
                name == "Compatibility_05.gltf") {
                EXPECT_THROW(loadGltf(file), InputError);
                continue;
            }
            Scene scene;
            ASSERT_NO_THROW(scene = loadGltf(file));
            for (const double time_s : {0.0, 0.4}) expectConsistent(scene, scene.at(time_s));
            ++count;
        }
    EXPECT_EQ(count, 149u);
}

struct Measured {
    const char* file;
    std::size_t triangles;
    glm::vec3 min, max;
};

TEST_F(GltfScenes, AreAsMeasured) {
    for (const Measured& expected : std::vector<Measured>{
             {"models/bird_seagull.glb", 27804, {-214.6, -512, 104.7}, {214.6, 512, 919.3}},
             {"models/spot_big_1500k.glb", 1499136, {-.4628, -.7343, -.6698}, {.4664, .9512, 1.048}},
             {"models/bicycle_48k.glb", 47832, {-1.917, -2.053, -.673}, {2.773, .4455, .6843}},
             {"models/fox_skinned.glb", 576, {-12.59, -.1217, -88.09}, {12.59, 78.91, 66.62}},
             {"models/ship_pirate.glb", 9498, {2.845, 0, -4.835}, {5.696, 6.547, 3.262}},
             {"models/plants_alpha_mask/plants_alpha_mask.gltf",
              52596,
              {-9.93, -.2805, -3.411},
              {8.619, 2.251, 2.664}},
             {"sponza/Sponza.gltf", 279163, {-19.21, -1.264, -11.83}, {18, 14.29, 11.05}},
             {"conformance/own/negative_scale.gltf", 36, {-.5, -.75, -.7071}, {4.707, .75, .7071}},
             {"conformance/own/nonuniform_matrix.gltf", 12, {-.4142, 1.646, 2.5}, {2.414, 2.354, 3.5}},
             {"conformance/own/deep_hierarchy_300.gltf", 12, {2.49, -.5, -.5}, {3.49, .5, .5}},
             {"conformance/own/strip.gltf", 4, {0, 0, 0}, {1, 2, .5}},
             {"conformance/own/fan.gltf", 8, {-1, -1, 0}, {1, 1, .5}},
             {"conformance/own/quantized_i16_unnormalized.gltf", 12, {-.5, -.5, -.5}, {.5, .5, .5}},
             {"conformance/SimpleSparseAccessor/SimpleSparseAccessor.gltf", 12, {0, 0, 0}, {6, 4, 0}}}) {
        SCOPED_TRACE(expected.file);
        const Scene scene = loadGltf(*scenes_ / expected.file, {.animations = std::vector<int>{}});
        const SceneMoment moment = scene.at(0);
        std::size_t triangles = 0;
        for (const Instance& instance : moment.instances)
            triangles += scene.meshes[std::size_t(instance.mesh)].indices.size() / 3;
        EXPECT_EQ(triangles, expected.triangles);
        const float tolerance = 1e-3f * glm::length(expected.max - expected.min);
        EXPECT_LE(glm::length(moment.bounds.min - expected.min), tolerance);
        EXPECT_LE(glm::length(moment.bounds.max - expected.max), tolerance);
    }
}

TEST_F(GltfScenes, LightsAreWhereTheirFileSays) {
    const std::vector<Light> lights =
        loadGltf(*scenes_ / "conformance/own/lights_punctual.gltf").at(0).lights;
    ASSERT_GE(lights.size(), 3u);
    EXPECT_EQ(lights[0].name, "sun");
    EXPECT_EQ(lights[0].shape.shape, LightShape::distant);
    EXPECT_EQ(lights[0].emission.unit, Emission::Unit::lux);
    EXPECT_FLOAT_EQ(lights[0].emission.value.y, 3 * 0.95f);
}

}  // namespace
}  // namespace penumbra::studio
