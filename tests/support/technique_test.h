// SPDX-License-Identifier: Apache-2.0
// What tests of techniques share: a device without a window, scenes with a light of one's own, and the truth.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "studio/metrics/visibility_metrics.h"
#include "studio/scene/scene.h"
#include "studio/workbench/workbench.h"

namespace penumbra::studio {

/// KEY, VALUE
using Settings = std::vector<std::pair<std::string, std::string>>;

/// Of the contexts that tests of techniques and hosts run in: PENUMBRA_TEST_PROFILE=compatibility asks for
/// those that many hosts have.
ContextProfile testProfile();

/// Fails a test after which the driver has reported an error, undefined behaviour or anything of high
/// severity.
class TechniqueTest : public ::testing::Test {
  public:
    /// One for the whole program: a device takes longer to make than most tests to run.
    static Workbench& workbench();

  protected:
    static constexpr PictureSize defaultSize{160, 120};

    void TearDown() override;

    /// The first light's result, from the first camera.
    static LightResult render(std::string_view technique, const Scene& scene, PictureSize size = defaultSize,
                              const Settings& settings = {}, double time_s = 0);
    /// The same with a technique that the test holds, so that it keeps its state from call to call.
    static LightResult render(Technique& technique, const Scene& scene, PictureSize size = defaultSize,
                              double time_s = 0);
    /// The ray-traced reference; not from the cache.
    static LightResult truth(const Scene& scene, PictureSize size = defaultSize, int samples = 256);

    /// Errors where the unshadowed light arrives.
    static VisibilityMetrics judge(const LightResult& truth, const LightResult& result);
    /// Share of the pixels that the light reaches where the two differ by more than `tolerance`.
    static double shareOfDifferentPixels(const LightResult& a, const LightResult& b, float tolerance);
};

/// For INSTANTIATE_TEST_SUITE_P: the catalog, and how a technique is called in a test's name.
inline auto everyTechnique() {
    std::vector<std::string> names;
    for (const TechniqueInfo& info : techniqueCatalog()) names.emplace_back(info.name);
    return ::testing::ValuesIn(names);
}
inline std::string techniqueTestName(const ::testing::TestParamInfo<std::string>& test) {
    std::string name = test.param;
    std::erase(name, '-');
    return name;
}

/// Where scenes lie that people met, if they are at hand: PENUMBRA_SHARED_SCENES, or beside the project.
/// Tests that need them skip without.
std::optional<std::filesystem::path> fieldScenes();

/// The scene with another light in place of all its own; `change` gets its first light to start from.
Scene withLight(Scene scene, const std::function<void(Light&)>& change);

/// The scene as `change` leaves each of its moments.
Scene withMoment(Scene scene, const std::function<void(SceneMoment&)>& change);

/// Whether it is a built-in scene's ground or room.
bool isGround(const Instance& instance);

/// The built-in scene with a ground or room that casts nothing, as the published techniques expect.
Scene onReceivingGround(Scene scene);

/// The scene with the picture's alpha, unfiltered, cut out of all its materials.
Scene withAlphaMask(Scene scene, Picture picture);

/// A light of size zero at the same place.
void shrinkToPoint(Light& light);

}  // namespace penumbra::studio
