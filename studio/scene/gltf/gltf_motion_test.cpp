// SPDX-License-Identifier: Apache-2.0
// Known answers: animations, morph targets and skins at a time.
#include <cmath>

#include "studio/errors.h"
#include "studio/scene/gltf/test_fixture.h"

namespace penumbra::studio {
namespace {

using Json = nlohmann::json;

class GltfMotionTest : public Gltf {
  protected:
    // Animates `path` of node 0.
    void animate(const std::string& path, int output, const std::string& interpolation,
                 const std::vector<float>& times_s = {0, 1, 2}) {
        const int input = gltf_.add("SCALAR", times_s);
        gltf_.json["animations"] = {
            {{"name", "clip"},
             {"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
             {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}}};
    }
};

TEST_F(GltfMotionTest, InterpolatesStepLinearAndCubic) {
    gltf_.addTriangle();
    const auto x = [&](double time_s) { return load().at(time_s).worldFromNode[0][3].x; };
    const int keys = gltf_.add<float>("VEC3", {0, 0, 0, 4, 0, 0, 6, 0, 0});
    animate("translation", keys, "STEP");
    EXPECT_FLOAT_EQ(x(0.75), 0);
    EXPECT_FLOAT_EQ(x(1.0), 4);
    animate("translation", keys, "LINEAR");
    EXPECT_FLOAT_EQ(x(0.75), 3);
    EXPECT_FLOAT_EQ(x(1.5), 5);
    EXPECT_FLOAT_EQ(x(2), 6);     // the last key
    EXPECT_FLOAT_EQ(x(2.25), 1);  // looped
    EXPECT_FLOAT_EQ(x(-0.5), 5);  // backwards
    // Keys are in-tangent, value, out-tangent. Half-way through two seconds the Hermite weights are 0.5,
    // 0.125 x 2, 0.5, -0.125 x 2: 0.5 x 0 + 0.25 x 8 + 0.5 x 4 - 0.25 x -12.
    const std::vector<float> zero{0, 0, 0}, out{8, 0, 0}, four{4, 0, 0}, in{-12, 0, 0};
    std::vector<float> splineKeys;
    for (const std::vector<float>& part : {zero, zero, out, in, four, zero})
        splineKeys.insert(splineKeys.end(), part.begin(), part.end());
    animate("translation", gltf_.add("VEC3", splineKeys), "CUBICSPLINE", {0, 2});
    EXPECT_FLOAT_EQ(x(1), 7);
    EXPECT_FLOAT_EQ(x(0), 0);
    EXPECT_DOUBLE_EQ(load().animations.at(0).duration_s, 2);
    EXPECT_EQ(load().animations[0].name, "clip");
}

TEST_F(GltfMotionTest, InterpolatesRotationsOnTheSphere) {
    gltf_.addTriangle();
    // From 0 to 120 degrees about Z, the second key with the other sign: the short way is taken all the same.
    const float s = std::sin(pi / 3), c = std::cos(pi / 3);
    animate("rotation", gltf_.add<float>("VEC4", {0, 0, 0, 1, 0, 0, -s, -c, 0, 0, 0, 1}), "LINEAR");
    const glm::mat4 world = load().at(0.25).worldFromNode[0];  // 30 degrees; a straight line would give 25.66
    EXPECT_NEAR(std::atan2(world[0].y, world[0].x), pi / 6, 1e-5);
}

TEST_F(GltfMotionTest, TheLastFrameShowsTheLastKey) {
    gltf_.addTriangle();
    const int keys = gltf_.add<float>("VEC3", {0, 0, 0, 9, 0, 0});
    for (const int frames : {24, 25, 31, 100}) {
        animate("translation", keys, "LINEAR", {0, float(frames) / 24});
        const auto x = [&](double frame) { return load().at(frame / 24).worldFromNode[0][3].x; };
        EXPECT_FLOAT_EQ(x(frames), 9) << frames;
        EXPECT_FLOAT_EQ(x(2 * frames), 9) << frames;
        EXPECT_FLOAT_EQ(x(0), 0) << frames;
        EXPECT_LT(x(frames + 1), 1) << frames;
    }
}

TEST_F(GltfMotionTest, AnimationsOfDifferentThingsPlayTogether) {
    gltf_.addTriangle();
    gltf_.json["nodes"].push_back({{"name", "lamp"}});
    gltf_.json["scenes"][0]["nodes"] = {0, 1};
    animate("translation", gltf_.add<float>("VEC3", {0, 0, 0, 4, 0, 0}), "LINEAR", {0, 1});
    gltf_.json["animations"].push_back(gltf_.json["animations"][0]);  // the same, another way
    gltf_.json["animations"].push_back(gltf_.json["animations"][0]);
    Json& ofTheLamp = gltf_.json["animations"][2];
    ofTheLamp["name"] = "LampAction";
    ofTheLamp["channels"][0]["target"]["node"] = 1;
    ofTheLamp["samplers"][0] = {{"input", gltf_.add<float>("SCALAR", {0, 2})},
                                {"output", gltf_.add<float>("VEC3", {0, 0, 0, 0, 8, 0})}};
    const Scene scene = load();
    EXPECT_DOUBLE_EQ(scene.duration_s(), 2);
    const SceneMoment moment = scene.at(1.5);
    EXPECT_FLOAT_EQ(moment.worldFromNode[0][3].x, 4);  // at its end, while the longer one goes on
    EXPECT_FLOAT_EQ(moment.worldFromNode[1][3].y, 6);
    EXPECT_TRUE(scene.animations[0].plays && !scene.animations[1].plays && scene.animations[2].plays);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_EQ(
        scene.warnings[0],
        "/animations: 'clip' would move what an earlier one moves and stands still; --animation chooses");
    const Scene chosen = load({.animations = std::vector{1, 2}});
    EXPECT_TRUE(!chosen.animations[0].plays && chosen.animations[1].plays && chosen.warnings.empty());
    EXPECT_FLOAT_EQ(chosen.at(0.5).worldFromNode[0][3].x, 2);
    EXPECT_FLOAT_EQ(chosen.at(0.5).worldFromNode[1][3].y, 2);
}

TEST_F(GltfMotionTest, PlaysTheChosenAnimationOrNone) {
    gltf_.addTriangle();
    animate("translation", gltf_.add<float>("VEC3", {1, 0, 0, 1, 0, 0, 1, 0, 0}), "LINEAR");
    gltf_.json["animations"].push_back(gltf_.json["animations"][0]);
    gltf_.json["animations"][1]["samplers"][0]["output"] =
        gltf_.add<float>("VEC3", {2, 0, 0, 2, 0, 0, 2, 0, 0});
    EXPECT_EQ(load().at(0).worldFromNode[0][3].x, 1);
    EXPECT_EQ(load({.animations = std::vector{1}}).at(0).worldFromNode[0][3].x, 2);
    EXPECT_EQ(load({.animations = std::vector<int>{}}).at(0).worldFromNode[0][3].x, 0);
    EXPECT_THROW(load({.animations = std::vector{2}}), InputError);
}

TEST_F(GltfMotionTest, MorphsAtATime) {
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

TEST_F(GltfMotionTest, SkinsAtATime) {
    Json& primitive = gltf_.addTriangle({0, 0, 0, 1, 0, 0, 1, 1, 0});
    // Vertex 0 on joint 0, vertex 1 half on each, vertex 2 on joint 1.
    primitive["attributes"]["JOINTS_0"] =
        gltf_.add<std::uint8_t>("VEC4", {0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0});
    primitive["attributes"]["WEIGHTS_0"] = gltf_.add<float>("VEC4", {1, 0, 0, 0, .5, .5, 0, 0, 1, 0, 0, 0});
    // Joint 1 is bound at (1, 0, 0); its node slides to y = 4 in two seconds.
    std::vector<float> inverseBind(32, 0.0f);
    for (int i = 0; i < 4; ++i) inverseBind[std::size_t(5 * i)] = inverseBind[std::size_t(16 + 5 * i)] = 1;
    inverseBind[16 + 12] = -1;
    gltf_.json["skins"] = {{{"joints", {2, 0}}, {"inverseBindMatrices", gltf_.add("MAT4", inverseBind)}}};
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

TEST_F(GltfMotionTest, KeepsTheFourLargestInfluencesAndNormalisesThem) {
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

TEST_F(GltfMotionTest, CopiesAMeshOverItsInstances) {
    gltf_.addTriangle();
    const int half = 1 << 14;  // of a turn, near enough: normalised
    gltf_.json["nodes"][0]["translation"] = {0, 0, 5};
    gltf_.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", gltf_.add<float>("VEC3", {0, 0, 0, 10, 0, 0})},
        {"ROTATION", gltf_.add<std::int16_t>("VEC4", {0, 0, 0, 32767, 0, 0, half, half}, true)},
        {"SCALE", gltf_.add<float>("VEC3", {1, 1, 1, 2, 2, -2})},
        {"_ID", gltf_.add<float>("SCALAR", {7, 8})}};
    const Scene scene = load();
    EXPECT_EQ(scene.meshes.size(), 1u);
    const SceneMoment moment = scene.at(0);
    ASSERT_EQ(moment.instances.size(), 2u);
    expectNear(moment.instances[0].worldFromMesh * glm::vec4(1, 0, 0, 1), {1, 0, 5});
    expectNear(moment.instances[1].worldFromMesh * glm::vec4(1, 0, 0, 1), {10, 2, 5});
    expectNear(moment.instances[1].worldFromMesh * glm::vec4(0, 0, 1, 1), {10, 0, 3});
    expectNear(moment.bounds.max, {10, 2, 5});
    expectNear(moment.bounds.min, {0, 0, 5});
}

}  // namespace
}  // namespace penumbra::studio
