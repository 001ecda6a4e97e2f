// SPDX-License-Identifier: Apache-2.0
// Files as exporters write them: all open, and what is left out is named.
#include <algorithm>

#include "studio/errors.h"
#include "studio/scene/gltf/test_fixture.h"
#include "studio/scene/solid.h"
#include "studio/scene/topology.h"

namespace penumbra::studio {
namespace {

class GltfField : public ::testing::Test {
  protected:
    void SetUp() override {
        scenes_ = sharedScenes();
        if (!scenes_) GTEST_SKIP() << "the shared scenes are not here; set PENUMBRA_SHARED_SCENES";
    }
    Scene load(const std::string& name) const { return loadGltf(*scenes_ / "field" / name); }

    std::optional<std::filesystem::path> scenes_;
};

std::vector<std::string> namesOf(const std::vector<Light>& lights) {
    std::vector<std::string> names;
    for (const Light& light : lights) names.push_back(light.name);
    return names;
}

bool isWarnedOf(const Scene& scene, const std::string& text) {
    return std::ranges::any_of(
        scene.warnings, [&](const std::string& warning) { return warning.find(text) != std::string::npos; });
}

TEST_F(GltfField, AllOpen) {
    std::size_t count = 0;
    for (const std::filesystem::path& file : gltfFiles(*scenes_ / "field")) {
        SCOPED_TRACE(file.string());
        EXPECT_NO_THROW(loadGltf(file).at(0.3));
        ++count;
    }
    EXPECT_GE(count, 50u);
}

TEST_F(GltfField, SpotsOfEqualAngles) {
    for (const char* name : {"spot-equal.glb", "three-default-spot.gltf"}) {
        const std::vector<Light> lights = load(name).at(0).lights;
        ASSERT_FALSE(lights.empty()) << name;
        EXPECT_EQ(lights[0].cone_rad.value()[0], lights[0].cone_rad.value()[1]) << name;
    }
}

TEST_F(GltfField, BlendersTwoAnimations) {
    const Scene scene = load("blender-two-animations.gltf");
    const SceneMoment first = scene.at(0), last = scene.at(scene.duration_s());
    EXPECT_GT(scene.duration_s(), 0);
    EXPECT_NE(first.worldFromNode[1][3], last.worldFromNode[1][3]) << "the cube";
    EXPECT_NE(first.worldFromNode[2][3], last.worldFromNode[2][3]) << "the lamp";
    EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(GltfField, LampsOfOneNameStayApart) {
    EXPECT_EQ(namesOf(load("two-lamps-of-one-name.gltf").at(0).lights),
              (std::vector<std::string>{"Lamp", "Lamp.001"}));
}

TEST_F(GltfField, BabylonsLights) {
    const Scene scene = load("babylon-area-and-punctual.gltf");
    EXPECT_EQ(namesOf(scene.at(0).lights), (std::vector<std::string>{"rect", "spot", "sun", "pt"}));
    EXPECT_TRUE(isWarnedOf(scene, "have a range"));
}

TEST_F(GltfField, Instances) {
    for (const char* name : {"instances-gpu_instancing_optional.glb", "instances-gpu_instancing_required.glb",
                             "instances-used_only.glb"}) {
        const Scene scene = load(name);
        EXPECT_EQ(scene.meshes.size(), 2u) << name;
        EXPECT_GT(scene.at(0).instances.size(), 2u) << name;
        EXPECT_TRUE(scene.warnings.empty()) << name;
    }
    EXPECT_EQ(load("instances-gpu_instancing_required.glb").at(0).instances.size(), 10001u);
}

TEST_F(GltfField, MasksOfVertices) {
    const Scene scene = load("leaves-vertexalpha.glb");
    std::size_t ramps = 0;
    for (const Mesh& mesh : scene.meshes) {
        const Material& material = scene.materials[std::size_t(mesh.material)];
        if (material.alpha != Material::Alpha::mask || material.baseColorTexture < 0) continue;
        ++ramps;
        EXPECT_EQ(mesh.uvs.size(), mesh.positions.size());
    }
    EXPECT_GT(ramps, 0u);
}

TEST_F(GltfField, WindowsLetTheSunIn) {
    for (const char* name :
         {"window-blend.glb", "window-transmission.glb", "glass-blend.glb", "glass-tint.glb"}) {
        const Scene scene = load(name);
        EXPECT_TRUE(isWarnedOf(scene, "1 pane of glass")) << name;
        const std::vector<Instance> instances = scene.at(0).instances;
        EXPECT_EQ(std::ranges::count(instances, false, &Instance::casts), 1) << name;
    }
    EXPECT_TRUE(load("window-open.glb").warnings.empty());
}

TEST_F(GltfField, SixPrimitivesAreOneClosedBox) {
    const Scene scene = load("box-6-primitives.glb");
    std::vector<int> surfaces;
    for (std::size_t i = 0; i < scene.meshes.size(); ++i)
        if (scene.meshes[i].solid == scene.meshes.back().solid) surfaces.push_back(int(i));
    EXPECT_EQ(surfaces.size(), 6u);
    const Solid box = joinMeshes(scene, surfaces);
    EXPECT_TRUE(analyzeTopology(box.positions, box.indices).closed());
}

// Every instance, light and camera lies where it does in the scene at the origin.
TEST_F(GltfField, FarFromTheOriginIsAsNear) {
    const SceneMoment near = load("georef-origin.glb").at(0);
    for (const char* name : {"georef-ladder_1000.glb", "georef-ladder_30000.glb", "georef-utm_nodes.glb"}) {
        SCOPED_TRACE(name);
        const Scene scene = load(name);
        EXPECT_NE(scene.worldFromFile, glm::dmat4(1));
        const SceneMoment far = scene.at(0);
        EXPECT_LT(glm::length(far.bounds.center()), 1 + glm::length(near.bounds.center()));
        const glm::vec3 moved =
            glm::vec3(far.cameras[0].worldFromCamera[3] - near.cameras[0].worldFromCamera[3]);
        for (std::size_t i = 0; i < near.instances.size(); ++i)
            expectNear(glm::vec3(far.instances[i].worldFromMesh[3] - near.instances[i].worldFromMesh[3]),
                       moved, 2e-5f);
    }
}

TEST_F(GltfField, GlowingSurfacesAreNamed) {
    EXPECT_TRUE(
        isWarnedOf(load("emissive-emissive.glb"), "1 of them glow; they are seen so, but light nothing"));
}

TEST_F(GltfField, WhatCannotBeReadIsNamed) {
    EXPECT_TRUE(isWarnedOf(load("textures-missing.glb"), "/images/0: left out"));
    EXPECT_TRUE(isWarnedOf(load("textures-f_trunc_png.glb"), "/images/0: left out"));
    EXPECT_TRUE(isWarnedOf(load("textures-f_cmyk_jpg.glb"), "CMYK"));
    EXPECT_TRUE(load("textures-f_pic_webp.glb").warnings.empty());
    EXPECT_TRUE(isWarnedOf(load("strict-req_variants.glb"), "KHR_materials_variants is left out"));
    EXPECT_TRUE(isWarnedOf(load("strict-ktx2_optional.glb"), "KHR_texture_basisu is left out"));
    EXPECT_EQ(load("strict-ktx2_optional.glb").pictures.size(), 1u);
}

}  // namespace
}  // namespace penumbra::studio
