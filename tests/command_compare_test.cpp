// SPDX-License-Identifier: Apache-2.0
// `compare` and `bench` as a script meets them.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "studio/image/image_io.h"
#include "tests/support/command_test.h"

namespace penumbra::studio {
namespace {

TEST_F(CommandTest, OneTechniqueComparesWithItselfAtOtherSettings) {
    const Outcome outcome =
        run("compare half-plane -t exact:samples=16,exact:samples=256,hard --set hard.map_size=64 "
            "--size 64x48 --samples 64 --json -o " +
            at("out"));
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    const auto& results = json.at("results");
    ASSERT_EQ(results.size(), 3u);
    EXPECT_EQ(results[0].at("technique"), "exact:samples=16");
    EXPECT_EQ(results[1].at("technique"), "exact:samples=256");
    EXPECT_GT(results[0].at("penumbra_rmse").get<double>(), results[1].at("penumbra_rmse").get<double>());

    // The numbers again, in files that say what made them.
    const auto file = nlohmann::json::parse(readText(at("out/results.json")));
    EXPECT_EQ(file.at("results"), results);
    for (const char* key : {"version", "commit", "date", "command", "processor", "driver"}) {
        EXPECT_FALSE(file.at("made").at(key).get<std::string>().empty()) << key;
    }
    std::istringstream csv(readText(at("out/results.csv")));
    std::string header, row;
    std::getline(csv, header);
    int rows = 0;
    while (std::getline(csv, row)) {
        EXPECT_EQ(std::ranges::count(row, ','), std::ranges::count(header, ',')) << row;
        EXPECT_TRUE(row.starts_with("half-plane,")) << row;
        ++rows;
    }
    EXPECT_EQ(rows, 3);
    const ExrPicture errors = readExr(at("out/exact_samples_16.visibility.exr"));
    const Image v = imageOf(errors, "V"), truth = imageOf(errors, "truth"), error = imageOf(errors, "error");
    ASSERT_EQ(error.values.size(), 64u * 48u);
    for (std::size_t i = 0; i < error.values.size(); ++i) {
        ASSERT_EQ(error.values[i], v.values[i] - truth.values[i]) << i;
    }
    EXPECT_TRUE(fs::exists(at("out/exact_samples_16.png")));
    EXPECT_NE(readText(at("out/report.html")).find("exact_samples_16.visibility.png"), std::string::npos);
}

TEST_F(CommandTest, ExceededThresholdExitsWithOne) {
    const std::string compare = "compare half-plane -t hard --size 64x48 --samples 16 --json ";
    // A hard edge through a ramp from 0 to 1 is wrong by 0.29 rms, up to the noise of 16 rays.
    const Outcome above = run(compare + "--fail-above max=1 --fail-above penumbra_rmse=0.1");
    EXPECT_EQ(above.exitCode, 1);
    for (const char* word : {"hard", "key", "penumbra_rmse is"}) {
        EXPECT_NE(above.err.find(word), std::string::npos) << above.err;
    }
    EXPECT_EQ(above.err.find("max is"), std::string::npos) << above.err;
    EXPECT_FALSE(above.out.empty()) << "the figures are printed all the same";
    EXPECT_EQ(run(compare + "--fail-above penumbra_rmse=0.5 --fail-above flip=1").exitCode, 0);
    for (const char* wrong : {"penumbra", "penumbra_rmse", "rmse=", "rmse=x", "rmse=nan", "=1"}) {
        EXPECT_EQ(run(compare + "--fail-above " + wrong).exitCode, 2) << wrong;
    }
}

TEST_F(CommandTest, CompareTellsAskedPromisedChosenAndTrue) {
    const std::string compare = "compare two-boxes --size 32x24 --samples 16 ";
    const Outcome table = run(compare + "--error 0.03 -t auto");
    ASSERT_EQ(table.exitCode, 0) << table.err;
    EXPECT_NE(table.out.find("auto, key: exact with samples = "), std::string::npos) << table.out;
    EXPECT_NE(table.out.find("error asked 0.03, promised 0.0"), std::string::npos) << table.out;
    const Outcome json = run(compare + "-t auto,hard --json");
    ASSERT_EQ(json.exitCode, 0) << json.err;
    const auto results = nlohmann::json::parse(json.out).at("results");
    EXPECT_EQ(results.at(0).at("chosen").get<std::string>().find("exact with samples = "), 0u);
    EXPECT_FALSE(results.at(1).contains("chosen"));
}

TEST_F(CommandTest, CompareKeepsItsContract) {
    const Outcome outcome =
        run("compare two-boxes -t hard --size 64x48 --samples 16 --json -o " + at("report"));
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json.at("scene"), "two-boxes");
    EXPECT_EQ(json.at("size"), (std::vector<int>{64, 48}));
    EXPECT_EQ(json.at("reference").at("samples"), 16);
    EXPECT_GE(json.at("reference").at("noise_rms"), 0);
    const auto& result = json.at("results").at(0);
    for (const char* key : {"technique", "light", "rmse", "mae", "penumbra_rmse", "p99", "max", "leak",
                            "false_shadow", "flip", "ms", "counts"}) {
        EXPECT_TRUE(result.contains(key)) << key;
    }
    for (const char* key : {"median", "min", "max"}) EXPECT_TRUE(result.at("ms").contains(key)) << key;

    for (const char* file : {"hard.png", "reference.png", "hard.visibility.png", "reference.visibility.png",
                             "hard.difference.png", "contact-sheet.png", "report.html"}) {
        EXPECT_TRUE(fs::exists(fs::path(at("report")) / file)) << file;
    }
    // Every picture that the report shows is there.
    const std::string html = readText(fs::path(at("report")) / "report.html");
    for (std::size_t from = html.find("src=\""); from != std::string::npos;
         from = html.find("src=\"", from + 5)) {
        const std::string source = html.substr(from + 5, html.find('"', from + 5) - from - 5);
        EXPECT_TRUE(fs::exists(fs::path(at("report")) / source)) << source;
    }
}

TEST_F(CommandTest, CompareLooksAtAllScenesBeforeItStarts) {
    EXPECT_EQ(
        run("compare half-plane nowhere.glb -t hard --size 32x32 --samples 4 -o " + at("report")).exitCode,
        3);
    EXPECT_TRUE(files().empty()) << "work on the first";
}

TEST_F(CommandTest, CompareRanksSeveralScenes) {
    const Outcome outcome =
        run("compare two-boxes torus -t hard,pcss --size 64x48 --samples 16 --json -o " + at("report"));
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    ASSERT_EQ(json.at("comparisons").size(), 2u);
    EXPECT_EQ(json.at("comparisons").at(1).at("scene"), "torus");
    ASSERT_EQ(json.at("ranking").size(), 2u);
    EXPECT_EQ(json.at("ranking").at(0).at("technique"), "pcss");
    EXPECT_EQ(json.at("ranking").at(1).at("ratio_to_hard"), 1);
    EXPECT_EQ(files(), std::vector<std::string>{"report"});
    for (const char* file : {"report.html", "tables.md", "two-boxes/pcss.png", "torus/report.html"})
        EXPECT_TRUE(fs::exists(fs::path(at("report")) / file)) << file;
    EXPECT_NE(readText(fs::path(at("report")) / "tables.md").find("| `torus` |"), std::string::npos);
}

TEST_F(CommandTest, FlickerNeedsSomethingThatMoves) {
    const std::string compare = "compare two-boxes -t hard --size 48x32 --samples 4 --json --flicker ";
    const Outcome still = run(compare + "animation");
    EXPECT_EQ(still.exitCode, 2);
    EXPECT_NE(still.err.find("no animation"), std::string::npos) << still.err;
    EXPECT_EQ(run(compare + "wind").exitCode, 2);
    EXPECT_EQ(run("compare two-boxes --fail-above flicker=1").exitCode, 2) << "nothing was to be measured";

    const Outcome moving = run(compare + "light --fail-above flicker=0");
    EXPECT_EQ(moving.exitCode, 1) << "a hard edge that moves jumps from texel to texel";
    EXPECT_NE(moving.err.find("flicker is"), std::string::npos) << moving.err;
    EXPECT_GT(nlohmann::json::parse(moving.out).at("results").at(0).at("flicker"), 0);
    const Outcome table = run("compare two-boxes -t hard --size 48x32 --samples 4 --flicker light");
    EXPECT_NE(table.out.find("popping"), std::string::npos) << table.out;
    EXPECT_EQ(run("compare two-boxes -t hard --size 48x32 --samples 4").out.find("popping"),
              std::string::npos);
}

TEST_F(CommandTest, BenchKeepsItsContract) {
    const Outcome outcome = run("bench two-boxes -t pcf --size 48x32 --rounds 2 --json -o " + at("bench"));
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    for (const char* key : {"machine", "renderer", "clock", "scene", "size", "motion", "results"})
        EXPECT_TRUE(json.contains(key)) << key;
    ASSERT_EQ(json.at("results").size(), 2u);
    EXPECT_EQ(json.at("results").at(0).at("technique"), "hard") << "the yardstick comes along";
    EXPECT_EQ(json.at("results").at(0).at("ratio_to_hard").at("median"), 1);
    EXPECT_EQ(json.at("results").at(1).at("rounds"), 2);
    for (const char* file : {"bench.json", "bench.csv", "tables.md", "report.html"})
        EXPECT_TRUE(fs::exists(fs::path(at("bench")) / file)) << file;

    EXPECT_EQ(run("bench two-boxes --axes weather").exitCode, 2);
    EXPECT_EQ(run("bench two-boxes -t pcf --set magic=1 --size 48x32").exitCode, 2);
}

TEST_F(CommandTest, SecondCompareTakesTheReferenceFromTheCache) {
    const std::string compare = "compare torus -t hard --size 64x48 --samples 16 --json";
    const auto first = nlohmann::json::parse(run(compare).out);
    const auto second = nlohmann::json::parse(run(compare).out);
    EXPECT_GT(first.at("reference").at("rays_per_second"), 0);
    // A trace made anew would have taken another time.
    EXPECT_EQ(first.at("reference"), second.at("reference"));
    EXPECT_EQ(first.at("results").at(0).at("rmse"), second.at("results").at(0).at("rmse"));
}

}  // namespace
}  // namespace penumbra::studio
