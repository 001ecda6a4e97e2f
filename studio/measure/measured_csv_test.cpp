// SPDX-License-Identifier: Apache-2.0
// What is handed out in pieces comes together again, and nothing else does.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "studio/errors.h"
#include "studio/measure/measured_files.h"
#include "studio/scene/builtin/builtin.h"

namespace penumbra::studio {
namespace {

namespace fs = std::filesystem;

class MeasuredCsv : public ::testing::Test {
  protected:
    void SetUp() override { fs::create_directories(folder_); }
    void TearDown() override { fs::remove_all(folder_); }

    Measurement prepared(int firstRow = 1, int lastRow = 4) const {
        PointSet set = planeGrid({{-1, 0.1, -1}, 2, 2}, 3, 4, scene_, scene_.at(0));
        set.keepRows(firstRow, lastRow, "--rows");
        return prepare(scene_, scene_.at(0), std::move(set), {.perLight = true});
    }
    /// As if it had been measured: each point has a number of its own.
    Measurement filled(int firstRow = 1, int lastRow = 4) const {
        Measurement measurement = prepared(firstRow, lastRow);
        for (std::size_t i = 0; i < measurement.values.size(); ++i) {
            const MeasuringPoint& point = measurement.set.points[i];
            const float number = 100.1f * float(point.row) + float(point.column) / 3;
            measurement.values[i] = {number, number / 100};
            for (auto& light : measurement.lights) light.lux[i] = number;
        }
        return measurement;
    }
    fs::path write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return folder_ / name;
    }
    std::string messageFor(const std::vector<std::string>& texts) const {
        std::vector<fs::path> files;
        for (const std::string& text : texts)
            files.push_back(write("part" + std::to_string(files.size()) + ".csv", text));
        Measurement measurement = prepared();
        try {
            mergeCsv(measurement, scene_, files);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }

    Scene scene_ = makeBuiltin("many-lights");
    fs::path folder_ = fs::temp_directory_path() / ("penumbra-measured-" + std::to_string(getpid()));
};

TEST_F(MeasuredCsv, PiecesMakeTheWhole) {
    const std::string whole = toCsv(filled(), scene_);
    Measurement merged = prepared();
    mergeCsv(merged, scene_,
             {write("b.csv", toCsv(filled(3, 4), scene_)), write("a.csv", toCsv(filled(1, 2), scene_))});
    EXPECT_EQ(toCsv(merged, scene_), whole);
    std::ostringstream ofMerged, ofWhole;
    printJson(ofMerged, merged, scene_, {"scene", "exact"});
    printJson(ofWhole, filled(), scene_, {"scene", "exact"});
    EXPECT_EQ(ofMerged.str(), ofWhole.str());
}

TEST_F(MeasuredCsv, TellsFileAndLine) {
    const std::string first = toCsv(filled(1, 2), scene_), second = toCsv(filled(3, 4), scene_);
    EXPECT_EQ(messageFor({first, second}), "");
    EXPECT_NE(messageFor({first}).find("6 of 12 points are in none"), std::string::npos);
    EXPECT_NE(messageFor({first, first}).find("part1.csv:2: "), std::string::npos);
    EXPECT_NE(messageFor({first, first}).find("is there twice"), std::string::npos);
    EXPECT_NE(messageFor({"", second}).find("part0.csv:1: its columns"), std::string::npos);
    EXPECT_NE(messageFor({"x,y,z\n"}).find("its columns"), std::string::npos);
    EXPECT_NE(messageFor({first + "1,2,3\n"}).find(".csv:8: 3 columns"), std::string::npos);
    std::string elsewhere = second;
    elsewhere.replace(elsewhere.find("\n") + 1, 2, "-7");
    EXPECT_NE(messageFor({first, elsewhere}).find("is none of the points"), std::string::npos);
    std::string wrong = second;
    wrong.replace(wrong.rfind(",") + 1, 1, "?");
    EXPECT_NE(messageFor({first, wrong}).find("is no number"), std::string::npos);
}

TEST_F(MeasuredCsv, JsonKeepsItsContract) {
    Measurement measurement = filled();
    measurement.inside[0] = "a \"desk\"";
    std::ostringstream out;
    printJson(out, measurement, scene_, {"many-lights", "exact"});
    const nlohmann::json json = nlohmann::json::parse(out.str());
    ASSERT_EQ(json["points"].size(), 12u);
    EXPECT_EQ(json["points"][0]["inside"], "a \"desk\"");
    EXPECT_TRUE(json["points"][0]["lux"].is_null());
    EXPECT_EQ(json["inside"]["a \"desk\""], 1);
    EXPECT_EQ(json["points"][1]["position"].size(), 3u);
    EXPECT_EQ(json["points"][1]["normal"], (nlohmann::json{0, 1, 0}));
    EXPECT_EQ(json["points"][1]["lights"].size(), measurement.lights.size());
    // The least of those that count, at column 1 of row 0.
    EXPECT_NEAR(json["min"].get<double>(), 1.0 / 3, 1e-5);
    EXPECT_NEAR(json["uniformity"].get<double>(), json["min"].get<double>() / json["mean"].get<double>(),
                1e-6);
    for (const char* key : {"mean", "max", "scene", "technique"}) EXPECT_TRUE(json.contains(key)) << key;
}

}  // namespace
}  // namespace penumbra::studio
