// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "studio/scene/builtin/builtin.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

using HardVolumesTest = TechniqueTest;

constexpr PictureSize size{240, 180};

Scene withIndices(Scene scene, const std::function<void(std::vector<std::uint32_t>&)>& change) {
    for (Mesh& mesh : scene.meshes) change(mesh.indices);
    return scene;
}

TEST_F(HardVolumesTest, EqualTheReferenceForALightOfSizeZero) {
    // One pixel in a thousand may see the two differ about the pixel's own edge.
    for (const char* name :
         {"primitives", "torus", "two-boxes", "overlapping-blockers", "columns", "half-plane"}) {
        const Scene scene = withLight(makeBuiltin(name), shrinkToPoint);
        const LightResult exact = truth(scene, size, 2);
        for (const char* counting : {"auto", "z-fail"}) {
            EXPECT_LE(shareOfDifferentPixels(
                          exact, render("hard-volumes", scene, size, {{"counting", counting}}), 0.5f),
                      0.001)
                << name << " " << counting;
        }
    }
}

TEST_F(HardVolumesTest, EyeInShadowOrInABlockerChangesNothing) {
    for (const glm::vec3 eye :
         {glm::vec3(0.05f, 0.31f, 0.02f), glm::vec3(0.3f, 0.05f, 0.2f), glm::vec3(0.1f, 1.0f, 0)}) {
        const Scene scene = withLight(withMoment(makeBuiltin("two-boxes"),
                                                 [&](SceneMoment& moment) {
                                                     Camera& camera = moment.cameras.front();
                                                     camera.worldFromCamera = glm::inverse(glm::lookAt(
                                                         eye, glm::vec3(1.5f, 0, -1), glm::vec3(0, 1, 0)));
                                                 }),
                                      shrinkToPoint);
        const LightResult exact = truth(scene, size, 2);
        for (const char* counting : {"z-pass", "z-fail"}) {
            EXPECT_LE(shareOfDifferentPixels(
                          exact, render("hard-volumes", scene, size, {{"counting", counting}}), 0.5f),
                      0.001)
                << counting;
        }
    }
}

TEST_F(HardVolumesTest, OrthographicViewsAndDistantLights) {
    const Scene scene =
        withLight(withMoment(makeBuiltin("two-boxes"),
                             [](SceneMoment& moment) { moment.cameras.front().orthographicHeight_m = 4.0f; }),
                  [](Light& light) {
                      light.shape.shape = LightShape::distant;
                      shrinkToPoint(light);
                  });
    const LightResult exact = truth(scene, size, 2);
    for (const char* counting : {"auto", "z-fail"}) {
        EXPECT_LE(shareOfDifferentPixels(exact, render("hard-volumes", scene, size, {{"counting", counting}}),
                                         0.5f),
                  0.001)
            << counting;
    }
}

TEST_F(HardVolumesTest, SoupNeedsNoOrderAndNoClosedMeshes) {
    const auto soup = [](int kind) {
        return withLight(withIndices(makeBuiltin("primitives"),
                                     [kind](std::vector<std::uint32_t>& indices) {
                                         for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
                                             // Some wound the other way.
                                             if (kind > 0 && i % 7 < 3) std::swap(indices[i], indices[i + 1]);
                                         }
                                         // Every triangle once more, so that edges have four faces.
                                         if (kind == 2) {
                                             const std::vector<std::uint32_t> copy = indices;
                                             indices.insert(indices.end(), copy.begin(), copy.end());
                                         }
                                         // Holes.
                                         if (kind == 3 && indices.size() > 30)
                                             indices.resize(indices.size() / 6 * 3);
                                     }),
                         shrinkToPoint);
    };
    for (const int kind : {1, 2, 3}) {
        const Scene scene = soup(kind);
        EXPECT_LE(shareOfDifferentPixels(truth(scene, size, 2), render("hard-volumes", scene, size), 0.5f),
                  0.001)
            << kind;
    }
}

TEST_F(HardVolumesTest, CapsCloseWhatIsOpenAndNothingElse) {
    const Settings capped = {{"open_meshes", "capped"}};
    const Scene closed = withLight(makeBuiltin("two-boxes"), shrinkToPoint);
    EXPECT_EQ(render("hard-volumes", closed, size, capped).visibility.values,
              render("hard-volumes", closed, size).visibility.values);
    // Boxes without the half of their sides: capped, no light shines out of them, or through to the ground.
    const Scene open = withIndices(closed, [](std::vector<std::uint32_t>& indices) {
        if (indices.size() == 36) indices.resize(18);
    });
    const LightResult exact = truth(open, size, 2), whole = render("hard-volumes", open, size, capped);
    EXPECT_LE(shareOfDifferentPixels(exact, render("hard-volumes", open, size), 0.5f), 0.001);
    EXPECT_GT(shareOfDifferentPixels(exact, whole, 0.5f), 0.005);
    for (std::size_t i = 0; i < exact.visibility.values.size(); ++i)
        ASSERT_LE(whole.visibility.values[i], exact.visibility.values[i] + 0.5f);
}

}  // namespace
}  // namespace penumbra::studio
