// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "src/gl/buffer.h"
#include "src/gl/texture.h"
#include "studio/bench/axes.h"
#include "studio/bench/bench_report.h"
#include "studio/bench/bench_scene.h"
#include "studio/bench/device_memory.h"
#include "studio/scene/open_scene.h"

namespace penumbra::studio {
namespace {

TEST(Spread, IsMedianAndQuartiles) {
    const Spread spread = spreadOf({9, 1, 5, 3, 7});
    EXPECT_EQ(spread.median, 5);
    EXPECT_EQ(spread.low, 3);
    EXPECT_EQ(spread.high, 7);
    EXPECT_EQ(spreadOf({4}).high, 4);
    EXPECT_EQ(spreadOf({}).median, 0);
}

TEST(DeviceMemory, CountsWhatIsMade) {
    Workbench workbench;
    const std::size_t before_bytes = memoryInUse_bytes();
    {
        const gl::Buffer buffer(1000, "a buffer");
        const gl::Texture texture({.width_px = 16,
                                   .height_px = 8,
                                   .layers = 3,
                                   .format = gl::Format::rgba16f,
                                   .label = "a texture"});
        const gl::Texture depth(
            {.width_px = 8, .height_px = 8, .levels = 2, .format = gl::Format::depth32f, .label = "depth"});
        EXPECT_EQ(memoryInUse_bytes() - before_bytes, 1000u + 16 * 8 * 3 * 8 + (64 + 16) * 4);
    }
    EXPECT_EQ(memoryInUse_bytes(), before_bytes);
    EXPECT_EQ(workbench.device().severeMessageCount(), 0);
}

TEST(BenchScene, HasWhatIsAskedFor) {
    for (const int triangles : {1'000, 16'000, 256'000, 2'100'000}) {
        // A torus of whole sides comes near, nearer the more there are.
        EXPECT_NEAR(trianglesOf(makeBenchScene({.triangles = triangles})), triangles, 0.03 * triangles);
    }
    const SceneMoment moment = makeBenchScene({.lights = 5, .lightSize_m = 0.25f}).at(0);
    ASSERT_EQ(moment.lights.size(), 5u);
    EXPECT_EQ(moment.lights[4].shape.width_m, 0.25f);
}

TEST(BenchAxes, ReachFarAndInOrder) {
    for (const AxisInfo& axis : benchAxes()) {
        EXPECT_TRUE(std::ranges::is_sorted(axis.values)) << axis.name;
        for (const int value : axis.small)
            EXPECT_TRUE(std::ranges::count(axis.values, value) || axis.name == "light-size");
    }
}

class ContestTest : public ::testing::Test {
  protected:
    std::vector<ContestResult> run(const std::vector<Contender>& contenders, ContestOptions options) {
        workbench.open(scene);
        return runContest(workbench, moment, moment.cameras.front(), {64, 36}, contenders, options);
    }
    const Scene scene = openScene("two-boxes");
    const SceneMoment moment = scene.at(0);
    Workbench workbench;
};

TEST_F(ContestTest, MeasuresEveryRoundAndRatiosToTheYardstick) {
    const auto results = run(contendersOf(std::vector<Contender>{{.label = "hard", .technique = "hard"},
                                                                 {.label = "pcss", .technique = "pcss"}}),
                             {.rounds = 3});
    ASSERT_EQ(results.size(), 2u);
    EXPECT_EQ(results[0].contender.label, "hard");
    for (const ContestResult& result : results) {
        EXPECT_EQ(result.rounds, 3);
        EXPECT_GT(result.cost_ms.median, 0);
        EXPECT_LE(result.cost_ms.low, result.cost_ms.median);
        EXPECT_GT(result.memory_bytes, 2048u * 2048u * 4u) << "a shadow map";
        EXPECT_FALSE(result.passes_ms.empty());
    }
    EXPECT_EQ(results[0].ratio.median, 1);
}

TEST_F(ContestTest, SaysWhoIsMissing) {
    const auto results =
        run({{"hard", "hard", {}}, {"x", "magic", {}}, {"y", "pcf", {{"magic", "1"}}}}, {.rounds = 1});
    EXPECT_TRUE(results[0].missing.empty());
    EXPECT_NE(results[1].missing.find("magic"), std::string::npos);
    EXPECT_NE(results[2].missing.find("magic"), std::string::npos);
    EXPECT_EQ(results[1].rounds, 0);
}

TEST_F(ContestTest, PatienceEndsButEveryoneHasARound) {
    const auto results = run(contendersOf({}), {.rounds = 5, .patience_ms = 0});
    EXPECT_EQ(results[0].rounds, 1);
}

TEST(BenchReport, CsvHasALineForEachNumber) {
    BenchReport report{.scene = "s"};
    report.results = {{.contender = {"hard", "hard", {}},
                       .cost_ms = {2, 1, 3},
                       .ratio = {1, 1, 1},
                       .rounds = 3,
                       .memory_bytes = 7}};
    EXPECT_NE(toCsv(report).find("\nscene,s,hard,2,1,3,1,1,1,3,7\n"), std::string::npos) << toCsv(report);
}

}  // namespace
}  // namespace penumbra::studio
