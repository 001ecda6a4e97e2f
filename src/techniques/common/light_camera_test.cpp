// SPDX-License-Identifier: Apache-2.0
// Where light cameras have it hard, in every technique that draws maps from them.
#include <array>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

#include "studio/scene/builtin/builtin.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

class LightCameraTest : public TechniqueTest, public ::testing::WithParamInterface<const char*> {};

INSTANTIATE_TEST_SUITE_P(MapTechniques, LightCameraTest,
                         ::testing::Values("hard", "pcf", "pcss", "shadow-width", "smoothies", "uniform",
                                           "adaptive"),
                         [](const auto& test) {
                             std::string name = test.param;
                             std::erase(name, '-');
                             return name;
                         });

/// Those whose maps alone say what hides the light.
class PanelInCeilingTest : public TechniqueTest, public ::testing::WithParamInterface<const char*> {};

INSTANTIATE_TEST_SUITE_P(MapTechniques, PanelInCeilingTest,
                         ::testing::Values("hard", "pcf", "pcss", "uniform", "adaptive"));

/// A point light that shines to all sides.
Scene withBulbAt(Scene scene, const glm::vec3& place) {
    return withLight(std::move(scene), [place](Light& light) {
        light.shape.shape = LightShape::sphere;
        light.shape.worldFromLight.columns[3] = {place.x, place.y, place.z, 1};
        shrinkToPoint(light);
    });
}

/// The bounds in the world of an instance, whose corner i is max along axis j where bit j of i is set.
std::array<glm::vec3, 8> cornersOf(const Scene& scene, const Instance& instance) {
    const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
    glm::vec3 low(mesh.positions.front()), high(low);
    for (const glm::vec3& p : mesh.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    std::array<glm::vec3, 8> corners;
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 corner((i & 1) ? high.x : low.x, (i & 2) ? high.y : low.y, (i & 4) ? high.z : low.z);
        corners[std::size_t(i)] = glm::vec3(instance.worldFromMesh * glm::vec4(corner, 1));
    }
    return corners;
}

TEST_P(LightCameraTest, ABulbOnTheRimOfACastersBoxLosesNoShadow) {
    // In a corner and on an edge: rounding puts corners of what it lights at ulps from it.
    const Scene scene = makeBuiltin("primitives");
    const SceneMoment moment = scene.at(0);
    for (const Instance& instance : moment.instances) {
        const std::array<glm::vec3, 8> corners = cornersOf(scene, instance);
        // Not the ground and boxes, which would touch the light themselves.
        if (scene.meshes[std::size_t(instance.mesh)].positions.size() < 50) continue;
        for (const glm::vec3& place : {corners[6], glm::mix(corners[3], corners[7], 0.125f)}) {
            SCOPED_TRACE(::testing::Message() << place.x << " " << place.y << " " << place.z);
            const Scene lit = withBulbAt(scene, place);
            EXPECT_LE(
                shareOfDifferentPixels(truth(lit, {96, 72}, 2), render(GetParam(), lit, {96, 72}), 0.5f),
                0.04);
        }
    }
}

/// A panel that shines down on a scene, its axis askew so that its plane's corners are no round numbers; in a
/// ceiling that is the scene's ground once more, `above_m` over the panel.
Scene underPanel(Scene scene, std::optional<float> above_m) {
    const glm::mat4 turned = glm::rotate(glm::mat4(1), 0.1f, glm::vec3(0.6f, 0.1f, 0.8f));
    const glm::mat4 lifted = glm::translate(turned, glm::vec3(0.1f, 6.3f, 0.2f));
    scene = withLight(std::move(scene), [lifted](Light& light) {
        const glm::mat4 down = glm::rotate(lifted, -glm::half_pi<float>(), glm::vec3(1, 0, 0));
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 4; ++row) {
                light.shape.worldFromLight.columns[std::size_t(column)][std::size_t(row)] = down[column][row];
            }
        }
    });
    if (!above_m) return scene;
    return withMoment(std::move(scene), [=](SceneMoment& moment) {
        Instance ceiling = moment.instances.front();  // the ground: y = 0
        ceiling.worldFromMesh = glm::translate(lifted, glm::vec3(0, *above_m, 0));
        moment.instances.push_back(ceiling);
    });
}

TEST_P(PanelInCeilingTest, HidesNothingOfIt) {
    const Settings quick =
        std::string_view(GetParam()) == "uniform" ? Settings{{"samples", "3"}} : Settings{};
    const LightResult open = render(GetParam(), underPanel(makeBuiltin("primitives"), {}), {96, 72}, quick);
    // In its plane; as far from it as rounding brings it; and where it is behind the panel beyond doubt.
    for (const float above_m : {0.0f, 1e-6f, -1e-6f, 1e-5f, 0.05f}) {
        SCOPED_TRACE(above_m);
        const LightResult room =
            render(GetParam(), underPanel(makeBuiltin("primitives"), above_m), {96, 72}, quick);
        // Windows differ, and with them texels, at borders of shadows.
        EXPECT_LE(shareOfDifferentPixels(open, room, 0.3f), 0.03);
    }
}

}  // namespace
}  // namespace penumbra::studio
