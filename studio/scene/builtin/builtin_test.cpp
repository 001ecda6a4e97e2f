// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/builtin/builtin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "studio/errors.h"
#include "studio/scene/topology.h"

namespace penumbra::studio {
namespace {

const std::set<std::string_view> sheets{"half-plane", "strip", "disk", "cloth", "ground", "shade"};

glm::vec3 positionOf(const Light& light) {
    const glm::mat4 worldFromLight = std::bit_cast<glm::mat4>(light.shape.worldFromLight);
    return glm::vec3(worldFromLight[3]);
}

bool isRigid(const glm::mat4& matrix) {
    const glm::mat3 rotation(matrix);
    const glm::mat3 product = glm::transpose(rotation) * rotation;
    float error = std::abs(glm::determinant(rotation) - 1);
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            error = std::max(error, std::abs(product[column][row] - (column == row ? 1.0f : 0.0f)));
    return error < 1e-5f;
}

std::size_t trianglesOf(const Scene& scene) {
    std::size_t count = 0;
    for (const Instance& instance : scene.at(0).instances)
        count += scene.meshes[instance.mesh].indices.size() / 3;
    return count;
}

class EveryBuiltin : public testing::TestWithParam<BuiltinInfo> {
  protected:
    Scene scene = makeBuiltin(GetParam().name);
};

INSTANTIATE_TEST_SUITE_P(Scenes, EveryBuiltin,
                         testing::ValuesIn(builtinScenes().begin(), builtinScenes().end()),
                         [](const auto& testCase) {
                             std::string name(testCase.param.name);
                             std::erase(name, '-');
                             return name;
                         });

TEST_P(EveryBuiltin, IsNamedAndDescribed) {
    EXPECT_EQ(scene.name, GetParam().name);
    EXPECT_FALSE(GetParam().summary.empty());
    EXPECT_TRUE(scene.warnings.empty());
    const std::set<std::string> names(scene.nodeNames.begin(), scene.nodeNames.end());
    EXPECT_EQ(names.size(), scene.nodeNames.size()) << "names of nodes must be unique";
}

TEST_P(EveryBuiltin, MeshesAreWellFormed) {
    for (const Mesh& mesh : scene.meshes) {
        SCOPED_TRACE(mesh.name);
        ASSERT_GE(mesh.material, 0);
        ASSERT_LT(std::size_t(mesh.material), scene.materials.size());
        ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
        for (const std::uint32_t index : mesh.indices) ASSERT_LT(index, mesh.positions.size());
        const Topology topology = analyzeTopology(mesh.positions, mesh.indices);
        EXPECT_EQ(topology.closed(), !sheets.contains(mesh.name));
        EXPECT_EQ(topology.flippedEdges, 0u);
        EXPECT_EQ(topology.nonManifoldEdges, 0u);
        EXPECT_EQ(topology.degenerateTriangles, 0u);
    }
}

TEST_P(EveryBuiltin, IsFiniteAndConsistentAtAllTimes) {
    const std::size_t instanceCount = scene.at(0).instances.size();
    for (double time_s : {0.0, 0.4, 1.0, 1.9, 3.99, 1234.5, -7.3, std::numeric_limits<double>::infinity()}) {
        SCOPED_TRACE(time_s);
        const SceneMoment moment = scene.at(time_s);
        ASSERT_EQ(moment.instances.size(), instanceCount);
        ASSERT_EQ(moment.worldFromNode.size(), scene.nodeNames.size());
        Bounds bounds;
        for (const Instance& instance : moment.instances) {
            const Mesh& mesh = scene.meshes[instance.mesh];
            SCOPED_TRACE(mesh.name);
            ASSERT_LT(std::size_t(instance.node), scene.nodeNames.size());
            EXPECT_TRUE(isRigid(instance.worldFromMesh));
            ASSERT_EQ(instance.positions.empty(), !mesh.deforms());
            const auto& positions = mesh.deforms() ? instance.positions : mesh.positions;
            const auto& normals = mesh.deforms() ? instance.normals : mesh.normals;
            ASSERT_EQ(positions.size(), mesh.positions.size());
            ASSERT_EQ(normals.size(), mesh.positions.size());
            for (const glm::vec3& position : positions)
                bounds.include(glm::vec3(instance.worldFromMesh * glm::vec4(position, 1)));
            for (const glm::vec3& normal : normals) ASSERT_NEAR(glm::length(normal), 1, 1e-5);
            for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
                const auto a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
                const glm::vec3 wound = glm::cross(positions[b] - positions[a], positions[c] - positions[a]);
                for (const auto corner : {a, b, c})
                    ASSERT_GT(glm::dot(normals[corner], glm::normalize(wound)), 0.5f);
            }
        }
        EXPECT_EQ(moment.bounds.min, bounds.min);
        EXPECT_EQ(moment.bounds.max, bounds.max);
        EXPECT_LT(bounds.radius(), 30);
    }
}

TEST_P(EveryBuiltin, StandsOnTheGround) {
    for (double time_s = 0; time_s < 4; time_s += 0.23) EXPECT_GE(scene.at(time_s).bounds.min.y, -1e-5f);
}

TEST_P(EveryBuiltin, LightsHaveASizeAndReachWhatTheyShineAt) {
    const SceneMoment moment = scene.at(0);
    ASSERT_FALSE(moment.lights.empty());
    for (const Light& light : moment.lights) {
        SCOPED_TRACE(light.name);
        EXPECT_TRUE(isRigid(std::bit_cast<glm::mat4>(light.shape.worldFromLight)));
        EXPECT_EQ(light.emission.unit, Emission::Unit::nits);
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_GT(light.emission.value[channel], 0);
            EXPECT_LT(light.emission.value[channel], light.shape.shape == LightShape::distant ? 2e9f : 1e6f)
                << "the sun has 1.6e9";
        }
        const AreaLight& shape = light.shape;
        EXPECT_EQ(shape.shape == LightShape::rect, shape.width_m > 0 && shape.height_m > 0);
        EXPECT_EQ(shape.shape == LightShape::disk || shape.shape == LightShape::sphere, shape.radius_m > 0);
        EXPECT_EQ(shape.shape == LightShape::distant, shape.angle_rad > 0);
        EXPECT_LT(light.texture, int(scene.textures.size()));
        if (shape.shape == LightShape::distant)
            EXPECT_LT(-shape.worldFromLight.columns[2][1], 0) << "comes from above";
        else
            EXPECT_GT(positionOf(light).y, 1.5f);
    }
}

TEST_P(EveryBuiltin, CamerasAreAboveTheGroundAndLookDown) {
    const SceneMoment moment = scene.at(0);
    ASSERT_FALSE(moment.cameras.empty());
    for (const Camera& camera : moment.cameras) {
        SCOPED_TRACE(camera.name);
        EXPECT_TRUE(isRigid(camera.worldFromCamera));
        EXPECT_GT(camera.worldFromCamera[3].y, 0.5f);
        EXPECT_GT(camera.worldFromCamera[2].y, 0);
    }
}

TEST(Builtin, PrimitivesHasAboutTenThousandTriangles) {
    const std::size_t triangles = trianglesOf(makeBuiltin("primitives"));
    EXPECT_GE(triangles, 9000u);
    EXPECT_LE(triangles, 11000u);
}

TEST(Builtin, ClosedFormScenesAreWhereTheirSummariesSay) {
    struct Expected {
        std::string_view name;
        glm::vec3 min, max;  // of the blocker
        LightShape shape;
    };
    for (const Expected& expected :
         {Expected{"half-plane", {-20, 2, -20}, {0, 2, 20}, LightShape::rect},
          Expected{"strip", {-0.2f, 2, -20}, {0.2f, 2, 20}, LightShape::rect},
          Expected{"disk-over-ground", {-0.4f, 2, -0.4f}, {0.4f, 2, 0.4f}, LightShape::disk}}) {
        SCOPED_TRACE(expected.name);
        const Scene scene = makeBuiltin(expected.name);
        const SceneMoment moment = scene.at(0);
        ASSERT_EQ(moment.instances.size(), 2u);
        EXPECT_TRUE(moment.instances[0].casts) << "the ground, as in every file";
        const Instance& blocker = moment.instances[1];
        EXPECT_TRUE(blocker.casts);
        Bounds bounds;
        for (const glm::vec3& position : scene.meshes[blocker.mesh].positions)
            bounds.include(glm::vec3(blocker.worldFromMesh * glm::vec4(position, 1)));
        EXPECT_EQ(bounds.min, expected.min);
        EXPECT_EQ(bounds.max, expected.max);

        ASSERT_EQ(moment.lights.size(), 1u);
        const AreaLight& light = moment.lights[0].shape;
        EXPECT_EQ(light.shape, expected.shape);
        EXPECT_EQ(positionOf(moment.lights[0]), glm::vec3(0, 4, 0));
        EXPECT_EQ(light.worldFromLight.columns[2][1], 1) << "shines straight down";
        EXPECT_EQ(light.width_m, expected.shape == LightShape::rect ? 1 : 0);
        EXPECT_EQ(light.height_m, expected.shape == LightShape::rect ? 1 : 0);
        EXPECT_EQ(light.radius_m, expected.shape == LightShape::disk ? 0.5f : 0);
        for (const Camera& camera : moment.cameras)
            EXPECT_LT(camera.worldFromCamera[3].y, 2) << "a camera above the blocker would see that instead";
    }
}

TEST(Builtin, MovingMovesAndRepeats) {
    const Scene scene = makeBuiltin("moving");
    ASSERT_EQ(scene.animations.size(), 1u);
    EXPECT_EQ(scene.animations[0].duration_s, 4);
    const SceneMoment start = scene.at(0), later = scene.at(0.9), again = scene.at(4);
    int moved = 0, deformed = 0;
    for (std::size_t i = 0; i < start.instances.size(); ++i) {
        moved += start.instances[i].worldFromMesh != later.instances[i].worldFromMesh;
        deformed += start.instances[i].positions != later.instances[i].positions;
        EXPECT_EQ(start.instances[i].worldFromMesh, again.instances[i].worldFromMesh);
        EXPECT_EQ(start.instances[i].positions, again.instances[i].positions);
    }
    EXPECT_EQ(moved, 3);
    EXPECT_EQ(deformed, 1);
}

TEST(Builtin, ManyLightsHasAllShapesAndTheWindowAPicture) {
    std::set<LightShape> shapes;
    const Scene many = makeBuiltin("many-lights");
    EXPECT_EQ(many.at(0).lights.size(), 5u);
    for (const Light& light : many.at(0).lights) shapes.insert(light.shape.shape);
    EXPECT_EQ(shapes.size(), 4u);

    const Scene window = makeBuiltin("textured-window");
    ASSERT_EQ(window.at(0).lights[0].texture, 0);
    const Picture& picture = window.pictures[window.textures[0].picture];
    EXPECT_EQ(picture.rgba.size(), std::size_t(4 * picture.width_px * picture.height_px));
}

TEST(Builtin, UnknownNamesAreAnErrorThatHelps) {
    try {
        makeBuiltin("primitivs");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "there is no built-in scene 'primitivs'; did you mean 'primitives'?");
    }
}

}  // namespace
}  // namespace penumbra::studio
