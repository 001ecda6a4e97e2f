// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/light_size.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "studio/scene/open_scene.h"

namespace penumbra::studio {
namespace {

/// A triangle, a point light of 8 candela, a spot and a sun of 3 lux, as KHR_lights_punctual has them.
class LightSizesTest : public testing::Test {
  protected:
    LightSizesTest() {
        std::filesystem::create_directories(folder_);
        std::ofstream(file()) << R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_lights_punctual"],
            "extensions": {"KHR_lights_punctual": {"lights": [
                {"type": "point", "intensity": 8}, {"type": "spot", "intensity": 8, "spot": {}},
                {"type": "directional", "intensity": 3}]}},
            "nodes": [{"name": "bulb", "extensions": {"KHR_lights_punctual": {"light": 0}}},
                      {"name": "spot", "extensions": {"KHR_lights_punctual": {"light": 1}}},
                      {"name": "sun", "extensions": {"KHR_lights_punctual": {"light": 2}}}],
            "scenes": [{"nodes": [0, 1, 2]}], "scene": 0})";
    }
    ~LightSizesTest() override { std::filesystem::remove_all(folder_); }

    std::string file() const { return (folder_ / "lamps.gltf").string(); }
    static bool isSaid(const Scene& scene, const std::string& words) {
        for (const std::string& warning : scene.warnings)
            if (warning.find(words) != std::string::npos) return true;
        return false;
    }

  private:
    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() /
        ("penumbra-sizes-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
};

TEST_F(LightSizesTest, AreMissedInAWordWithTheRemedy) {
    const Scene scene = openScene(file());
    EXPECT_TRUE(isSaid(scene,
                       "have no size, so that shadows are hard: --light-radius 0.05 makes lamps of 10 cm, "
                       "--sun-angle 0.53"));
}

TEST_F(LightSizesTest, AreGivenToThoseThatHaveNoneAndKeepWhatTheyGive) {
    const float radius_m = 0.05f, angle_rad = 0.01f;
    const SceneMoment hard = openScene(file()).at(0);
    const Scene scene = openScene(file(), {.lightSizes = {radius_m, angle_rad}});
    EXPECT_FALSE(isSaid(scene, "no size"));
    const SceneMoment soft = scene.at(0);
    ASSERT_EQ(soft.lights.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        const Light &before = hard.lights[i], &after = soft.lights[i];
        EXPECT_EQ(effectOf(before.shape), 0);
        EXPECT_EQ(after.emission.unit, Emission::Unit::nits);
        const bool isSun = after.shape.shape == LightShape::distant;
        EXPECT_EQ(isSun ? after.shape.angle_rad : after.shape.radius_m, isSun ? angle_rad : radius_m);
        EXPECT_NEAR(after.emission.value.r * effectOf(after.shape), before.emission.value.r,
                    1e-5f * before.emission.value.r);
    }
}

TEST_F(LightSizesTest, OfAFileStay) {
    const Scene as = openScene("torus"), told = openScene("torus", {.lightSizes = {0.3f, 0.1f}});
    EXPECT_EQ(effectOf(as.at(0).lights[0].shape), effectOf(told.at(0).lights[0].shape));
}

}  // namespace
}  // namespace penumbra::studio
