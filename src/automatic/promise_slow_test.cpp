// SPDX-License-Identifier: Apache-2.0
// Whether what is promised is kept: every built-in scene, and those of the field where they are at hand.
#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>

#include "penumbra/promise.h"
#include "studio/scene/builtin/builtin.h"
#include "studio/scene/open_scene.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

class PromiseTest : public TechniqueTest {
  protected:
    static constexpr PictureSize size{64, 48};

    /// Rays a pixel: enough for most scenes, and for those that do not seem to keep their promise.
    static constexpr int someRays = 1024, manyRays = 32768;

    static TechniqueResult truthOf(const SceneMoment& moment, int rays) {
        const std::unique_ptr<Technique> reference = workbench().makeTechnique("reference");
        setParameter(*reference, "samples", std::to_string(rays));
        setParameter(*reference, "cache", "false");
        return workbench().run("reference", *reference, moment, moment.cameras.front(), size);
    }

    static TechniqueResult resultOf(const SceneMoment& moment, const char* error) {
        const std::unique_ptr<Technique> automatic = workbench().makeTechnique("auto");
        setParameter(*automatic, "max_error", error);
        return workbench().run("auto", *automatic, moment, moment.cameras.front(), size);
    }

    static double largestError(const TechniqueResult& truth, const TechniqueResult& result) {
        double largest = 0;
        for (std::size_t i = 0; i < truth.lights.size(); ++i)
            largest = std::max(largest, judge(truth.lights[i], result.lights[i]).penumbra_rmse);
        return largest;
    }

    static void expectKept(const std::string& name, const Scene& scene) {
        workbench().open(scene);
        const SceneMoment moment = scene.at(0);
        if (moment.lights.empty()) return;
        TechniqueResult truth = truthOf(moment, someRays);
        int rays = someRays;
        for (const char* error : {"0.05", "0.02", "0.01", "0.005"}) {
            const TechniqueResult result = resultOf(moment, error);
            double measured = largestError(truth, result);
            if (measured > std::stod(error) && rays != manyRays) {
                rays = manyRays;
                truth = truthOf(moment, rays);
                measured = largestError(truth, result);
            }
            EXPECT_LE(measured, std::stod(error)) << name << " at " << rays << " rays";
        }
    }
};

TEST_F(PromiseTest, IsKeptInBuiltinScenes) {
    for (const BuiltinInfo& info : builtinScenes())
        expectKept(std::string(info.name), makeBuiltin(info.name));
}

TEST_F(PromiseTest, IsKeptInScenesOfTheField) {
    const std::optional<std::filesystem::path> field = fieldScenes();
    if (!field) GTEST_SKIP() << "no scenes of the field here";
    for (const auto& entry : std::filesystem::directory_iterator(*field)) {
        if (entry.path().extension() != ".glb") continue;
        const std::string name = entry.path().stem().string();
        expectKept(name, openScene(entry.path().string()));
    }
}

}  // namespace
}  // namespace penumbra::studio
