// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/default_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "studio/scene/hints.h"
#include "studio/scene/open_scene.h"

namespace penumbra::studio {
namespace {

/// A box that stands on y = 0, as large as `size_m`, whose faces look inwards or outwards.
Scene boxScene(const glm::vec3& size_m, bool inwards) {
    Scene scene;
    scene.materials.push_back({});
    scene.nodeNames = {"box"};
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions.push_back(size_m * glm::vec3((i & 1) - 0.5f, (i >> 1) & 1, (i >> 2) - 0.5f));
    mesh.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                    2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    if (inwards)
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
            std::swap(mesh.indices[i], mesh.indices[i + 1]);
    scene.meshes.push_back(mesh);
    return scene;
}

SceneMoment momentOf(const Scene& scene) {
    SceneMoment moment;
    moment.instances.push_back({});
    for (const glm::vec3& position : scene.meshes[0].positions) moment.bounds.include(position);
    return moment;
}

TEST(DefaultCamera, StandsInARoomAndLooksAlongIt) {
    const Scene scene = boxScene({4, 2.5f, 9}, true);
    const SceneMoment moment = momentOf(scene);
    const Camera camera = defaultCamera(scene, moment, moment.bounds);
    const glm::vec3 eye(camera.worldFromCamera[3]), ahead(-camera.worldFromCamera[2]);
    EXPECT_NEAR(eye.y, 1.5f, 0.11f);
    EXPECT_LT(std::abs(eye.x), 2);
    EXPECT_GT(std::abs(eye.z), 3);
    EXPECT_LT(std::abs(eye.z), 4.5f);
    EXPECT_GT(-ahead.z * eye.z, 2) << "along the room, towards its other end";
}

TEST(DefaultCamera, StaysOutOfThings) {
    const auto isOutside = [](const Scene& scene) {
        const SceneMoment moment = momentOf(scene);
        const glm::vec3 eye(defaultCamera(scene, moment, moment.bounds).worldFromCamera[3]);
        return glm::any(glm::greaterThan(eye, moment.bounds.max));
    };
    EXPECT_TRUE(isOutside(boxScene({4, 2.5f, 9}, false))) << "closed";
    EXPECT_TRUE(isOutside(boxScene({1.3f, 0.13f, 0.14f}, true))) << "hollow, but nothing to stand in";
}

TEST(Hints, DoubtUnitsAndAxes) {
    for (const auto& [size_m, isDoubted] :
         {std::pair(300.0f, true), {150.0f, false}, {0.03f, false}, {0.01f, true}})
        EXPECT_EQ(unitHint(momentOf(boxScene({size_m, size_m, size_m}, false))).has_value(), isDoubted)
            << size_m;
    const Scene standing = boxScene({4, 0.2f, 9}, false), lying = boxScene({4, 9, 0.2f}, false);
    EXPECT_FALSE(upHint(standing, momentOf(standing)));
    EXPECT_TRUE(upHint(lying, momentOf(lying)));
}

class DefaultCameraField : public testing::Test {
  protected:
    void SetUp() override {
        const char* variable = std::getenv("PENUMBRA_SHARED_SCENES");
        field_ = std::filesystem::path(variable ? variable : PENUMBRA_DEFAULT_SHARED_SCENES) / "field";
        if (!std::filesystem::is_directory(field_)) GTEST_SKIP() << "the shared scenes are not here";
    }
    std::filesystem::path field_;
};

TEST_F(DefaultCameraField, RoomsAreSeenFromWithin) {
    for (const char* name : {"room-0.glb", "room-1mm.glb", "room-bulb.glb"}) {
        const SceneMoment moment = openScene((field_ / name).string()).at(0);
        const glm::vec3 eye(moment.cameras.at(0).worldFromCamera[3]);
        EXPECT_TRUE(glm::all(glm::lessThan(eye, moment.bounds.max)) &&
                    glm::all(glm::greaterThan(eye, moment.bounds.min)))
            << name;
    }
}

TEST_F(DefaultCameraField, MillimetresWithZUp) {
    const std::string file = (field_ / "mm-z-up.glb").string();
    const Scene asMetres = openScene(file);
    EXPECT_EQ(std::ranges::count_if(asMetres.warnings,
                                    [](const std::string& warning) {
                                        return warning.find("--unit mm") != std::string::npos ||
                                               warning.find("--up z") != std::string::npos;
                                    }),
              2);
    const Scene scene = openScene(file, {.reading = {.unit_m = 1e-3, .up = UpAxis::z}});
    const Bounds before = asMetres.at(0).bounds, bounds = scene.at(0).bounds;
    EXPECT_NEAR(bounds.max.y, 1e-3f * before.max.z, 1e-5f);
    EXPECT_NEAR(bounds.max.x, 1e-3f * before.max.x, 1e-5f);
    // (150, 100, 800) of the file, shining along its -Z: down.
    const auto& columns = scene.at(0).lights.at(0).shape.worldFromLight.columns;
    EXPECT_NEAR(columns[3][0], 0.15f, 1e-5f);
    EXPECT_NEAR(columns[3][1], 0.8f, 1e-5f);
    EXPECT_NEAR(columns[3][2], -0.1f, 1e-5f);
    EXPECT_NEAR(columns[2][1], 1, 1e-5f);
}

}  // namespace
}  // namespace penumbra::studio
