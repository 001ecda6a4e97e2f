// SPDX-License-Identifier: Apache-2.0
// Where casters stand on what they shade, lights lie in what casts, and faces are far larger than what is
// seen of them: edges begin beside the receiver there, and counts are asked for within rounding of their
// changes.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>

#include "studio/scene/builtin/builtin.h"
#include "studio/scene/builtin/mesh_kit.h"
#include "studio/scene/builtin/placing.h"
#include "studio/scene/open_scene.h"
#include "tests/support/technique_test.h"
#include "tests/support/wrong_pixels.h"

namespace penumbra::studio {
namespace {

class SoftVolumesContactTest : public TechniqueTest {
  protected:
    /// Errors where more arrives than at surfaces in a flat light's own plane, of which rounding decides
    /// which side they show.
    static VisibilityMetrics judgeReached(const LightResult& truth, const LightResult& result) {
        const float most = std::ranges::max(truth.reach.values);
        std::vector<std::uint8_t> reached;
        for (const float irradiance : truth.reach.values) reached.push_back(irradiance > 1e-6f * most);
        return compareVisibility(truth.visibility, result.visibility, reached);
    }
};

constexpr PictureSize small{160, 90};

/// The scene of two boxes with these meshes in their place, under a panel that shines down.
Scene underPanel(std::vector<std::pair<Mesh, glm::vec3>> casters, const glm::vec3& panel, glm::vec2 size_m,
                 bool twoSided = false) {
    Scene scene = makeBuiltin("two-boxes");
    const Mesh old = scene.meshes.back();
    for (auto& [mesh, place] : casters) {
        mesh.name = "caster";
        mesh.material = old.material;
        scene.meshes.push_back(mesh);
    }
    const int first = int(scene.meshes.size()) - int(casters.size());
    return withMoment(std::move(scene), [=](SceneMoment& moment) {
        std::erase_if(moment.instances, [](const Instance& instance) { return !isGround(instance); });
        for (int i = 0; i < int(casters.size()); ++i) {
            Instance instance{.mesh = first + i, .node = 0};
            instance.worldFromMesh = glm::translate(glm::mat4(1), casters[std::size_t(i)].second);
            moment.instances.push_back(instance);
        }
        moment.lights.resize(1);
        moment.lights.front() = rectLight("panel", 1, 1, panel, panel - glm::vec3(0, 1, 0), 1000);
        moment.lights.front().shape.width_m = size_m.x;
        moment.lights.front().shape.height_m = size_m.y;
        moment.lights.front().shape.twoSided = twoSided;
    });
}

// Its edges at the floor reach below the receivers beside it.
TEST_F(SoftVolumesContactTest, ABoxOnAFloorIsSmoothUpToTheContact) {
    const Scene scene = underPanel({{box({0.3f, 1.2f, 0.3f}), {0, 0.6f, 0}}}, {0.2f, 2.4f, 0}, {1.2f, 0.6f});
    const LightResult exact = truth(scene, small);
    for (const char* samples : {"64", "256"}) {
        const LightResult result = render("soft-volumes", scene, small, {{"samples", samples}});
        // The truth's own noise is 0.02 in the middle of a penumbra.
        EXPECT_LE(judge(exact, result).penumbra_rmse, 0.02) << samples;
        EXPECT_LE(judge(exact, result).leak, 0) << samples;
        EXPECT_EQ(wrongSinglePixels(exact, result), 0) << samples;
    }
}

// More points ask more questions within rounding of an edge; each has the same answer for all that ask it.
TEST_F(SoftVolumesContactTest, NoPixelIsWrongByItselfWithAnyNumberOfPoints) {
    const Scene scene = makeBuiltin("primitives");
    const LightResult exact = truth(scene, {240, 135});
    for (const char* samples : {"16", "64", "256"}) {
        const LightResult result = render("soft-volumes", scene, {240, 135}, {{"samples", samples}});
        EXPECT_EQ(wrongSinglePixels(exact, result), 0) << samples;
    }
    const Scene moving = makeBuiltin("moving");
    for (const double time_s : {0.7, 1.9}) {
        const LightResult result = render("soft-volumes", moving, {240, 135}, {}, time_s);
        const LightResult moved =
            render("reference", moving, {240, 135}, {{"samples", "256"}, {"cache", "false"}}, time_s);
        EXPECT_EQ(wrongSinglePixels(moved, result), 0) << time_s;
    }
}

TEST_F(SoftVolumesContactTest, APanelFlushWithWhatCastsIsSeenWhole) {
    const Mesh slab = box({3, 0.1f, 3}), sheet = plane(3, 3);
    struct Case {
        const char* name;
        Mesh ceiling;
        float height_m;  // of its middle; the panel is at 2.4 m
    };
    const Case cases[] = {{"under a slab", slab, 2.45f},
                          {"a rounding below it", slab, 2.450001f},
                          {"a rounding in it", slab, 2.449999f},
                          {"on a sheet", sheet, 2.4f}};
    for (const Case& one : cases) {
        for (const bool twoSided : {false, true}) {
            const Scene scene =
                underPanel({{one.ceiling, {0, one.height_m, 0}}}, {0, 2.4f, 0}, {1, 1}, twoSided);
            for (const char* technique : {"soft-volumes", "hard-volumes"}) {
                if (twoSided && technique == std::string_view("hard-volumes")) continue;
                const VisibilityMetrics metrics =
                    judgeReached(truth(scene, small, 64), render(technique, scene, small));
                EXPECT_LE(metrics.rmse, 0.01) << technique << " " << one.name << " " << twoSided;
            }
        }
    }
}

// A box whose corner is in the panel's plane, and one that covers a part of it.
TEST_F(SoftVolumesContactTest, CastersThatTouchAPanelsPlaneHideNoMoreThanTheyCover) {
    for (const glm::vec3& place : {glm::vec3(0.6f, 2.65f, 0), glm::vec3(0.75f, 2.65f, 0.75f)}) {
        const Scene scene = underPanel({{box({0.5f, 0.5f, 0.5f}), place}}, {0, 2.4f, 0}, {1, 1});
        const VisibilityMetrics metrics =
            judge(truth(scene, small, 64), render("soft-volumes", scene, small));
        EXPECT_LE(metrics.rmse, 0.01);
    }
}

// A ground hundreds of times as large as what stands on it casts no shadow on itself.
TEST_F(SoftVolumesContactTest, FacesFarLargerThanThePictureHideNothingOfThemselves) {
    for (const float width_m : {80.0f, 200.0f, 630.0f, 2000.0f}) {
        const Scene scene = underPanel(
            {{plane(width_m, width_m), {3.7f, 0, -1.9f}}, {box({0.4f, 0.5f, 0.4f}), {0, 0.25f, 0}}},
            {0.9f, 2.4f, 0.7f}, {0.5f, 0.5f});
        const LightResult exact = truth(scene, small);
        for (const char* technique : {"soft-volumes", "hard-volumes"}) {
            const VisibilityMetrics metrics = judge(exact, render(technique, scene, small));
            EXPECT_LE(metrics.false_shadow, 0.001) << technique << " " << width_m;
        }
        EXPECT_LE(judge(exact, render("soft-volumes", scene, small)).penumbra_rmse, 0.03) << width_m;
    }
}

/// Scenes that people met, where they are at hand.
TEST_F(SoftVolumesContactTest, ScenesOfTheFieldAreRight) {
    const std::optional<std::filesystem::path> field = fieldScenes();
    if (!field) GTEST_SKIP() << "no shared scenes beside the project";
    for (const char* name : {"pillar-base", "pillar-yaw20", "ceiling-h27", "ceiling-below_1e-06",
                             "ceiling-rot_tilt", "fixture-fixture", "room-0", "room-1mm", "city-2",
                             "city-triangle", "ground-boxes", "ground-volumes", "desk-cord"}) {
        Scene scene = openScene((*field / name).string() + ".glb");
        if (name == std::string_view("ground-volumes")) {
            scene = withMoment(std::move(scene), [](SceneMoment& moment) {
                moment.cameras = {camera("near", {-3.47657f, 0.468566f, 6.61572f}, {0, 0.228347f, 0})};
            });
        }
        if (name == std::string_view("ground-boxes")) {
            scene = withMoment(std::move(scene), [](SceneMoment& moment) {
                moment.cameras = {
                    camera("near", {0, 0.18208f, 0.330334f}, {0, 0.0362709f, 0}, glm::radians(40.0f))};
            });
        }
        const LightResult exact = truth(scene, small, 1024);
        const VisibilityMetrics metrics = judgeReached(exact, render("soft-volumes", scene, small));
        EXPECT_LE(metrics.penumbra_rmse, 0.01) << name;
        EXPECT_LE(metrics.rmse, 0.01) << name;
        for (const char* counting : {"z-pass", "z-fail"}) {
            const LightResult hard = render("hard-volumes", scene, small, {{"counting", counting}});
            EXPECT_LE(judgeReached(exact, hard).false_shadow, 0.002) << name << " " << counting;
        }
    }
}

}  // namespace
}  // namespace penumbra::studio
