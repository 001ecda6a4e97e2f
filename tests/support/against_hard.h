// SPDX-License-Identifier: Apache-2.0
// No penumbra is better than a wrong one: what a technique shows, held against `hard`.
#pragma once

#include <initializer_list>

#include "studio/scene/builtin/builtin.h"
#include "studio/scene/open_scene.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {

class AgainstHardTest : public TechniqueTest {
  protected:
    static constexpr PictureSize size{160, 90};
    static constexpr int rays = 64;
    static constexpr double sameError = 0.001;  ///< between errors against the same truth
    /// Of a picture: so much may be lit where it is umbra or dark where it is lit, more than with `hard`.
    static constexpr double wrongShare = 0.0025;

    /// The first light's visibility has no larger error than with `hard`, nor more pixels that are wrong.
    static void expectNoWorse(std::string_view technique, const Scene& scene, std::string_view name) {
        const LightResult exact = truth(scene, size, rays);
        const VisibilityMetrics hard = judge(exact, render("hard", scene, size));
        const VisibilityMetrics own = judge(exact, render(technique, scene, size));
        EXPECT_LE(own.rmse, hard.rmse + sameError) << name;
        EXPECT_LE(wrong(own), wrong(hard) + wrongShare) << name;
    }

    static void expectNoWorseInBuiltinScenes(std::string_view technique) {
        for (const BuiltinInfo& info : builtinScenes())
            expectNoWorse(technique, makeBuiltin(info.name), info.name);
    }

    static void expectNoWorseInTheField(std::string_view technique,
                                        std::initializer_list<const char*> scenes) {
        const std::optional<std::filesystem::path> field = fieldScenes();
        if (!field) GTEST_SKIP() << "no scenes of the field here";
        for (const char* name : scenes)
            expectNoWorse(technique, openScene((*field / name).string() + ".glb"), name);
    }

  private:
    static double wrong(const VisibilityMetrics& metrics) {
        const double pixels =
            metrics.leak * double(metrics.umbraSamples) + metrics.false_shadow * double(metrics.litSamples);
        return metrics.samples == 0 ? 0 : pixels / double(metrics.samples);
    }
};

}  // namespace penumbra::studio
