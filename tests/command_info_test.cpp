// SPDX-License-Identifier: Apache-2.0
// `info` as a script meets it.
#include <nlohmann/json.hpp>

#include "tests/support/command_test.h"

namespace penumbra::studio {
namespace {

TEST_F(CommandTest, InfoTellsWhatAutoTakesAndWhy) {
    for (const std::string error : {"0.05", "0.005"}) {
        const Outcome info = run("info many-lights --json --error " + error);
        ASSERT_EQ(info.exitCode, 0) << info.err;
        const Outcome rendered = run("render many-lights --size 32x24 --json --error " + error);
        ASSERT_EQ(rendered.exitCode, 0) << rendered.err;
        const auto lights = nlohmann::json::parse(info.out).at("lights");
        ASSERT_EQ(lights.size(), 5u);
        for (std::size_t i = 0; i < lights.size(); ++i) {
            const auto chosen =
                nlohmann::json::parse(rendered.out).at("lights").at(i).at("statistics").at("chosen");
            EXPECT_EQ(lights.at(i).at("auto").at("technique"), chosen.at("technique"));
            EXPECT_EQ(lights.at(i).at("auto").at("samples"), chosen.at("samples"));
        }
        const std::string table = run("info many-lights --error " + error).out;
        EXPECT_NE(table.find("auto        moon: exact with samples = "), std::string::npos) << table;
        EXPECT_NE(table.find("of what keeps " + error), std::string::npos) << table;
    }
    for (const char* error : {"0", "-1", "nan", "2", "0.00001"})
        EXPECT_EQ(run(std::string("info many-lights --error=") + error).exitCode, 2) << error;
}

TEST_F(CommandTest, InfoPrintsWhatWasLoaded) {
    const Outcome outcome = run("info primitives");
    ASSERT_EQ(outcome.exitCode, 0);
    for (const char* word : {"triangles", "vertices", "bounds", "boundary edges", "RectLight", "camera"}) {
        EXPECT_NE(outcome.out.find(word), std::string::npos) << word;
    }
}

TEST_F(CommandTest, InfoReadsLuminaires) {
    const std::string isotropic =
        "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 -0.3 -0.3 0\n1 1 10\n0 180\n0\n100 100\n";
    write("lamp.ies", isotropic);
    const Outcome outcome = run("info " + at("lamp.ies") + " --candela 30,60 --candela 120,0 --json");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_NEAR(double(json["lumens"]), 1256.64, 0.01);
    EXPECT_EQ(json["max_candela"], 100);
    EXPECT_EQ(json["opening"]["shape"], "circle");
    EXPECT_NEAR(double(json["opening"]["diameter_m"]), 0.3, 1e-12);
    ASSERT_EQ(json["candela"].size(), 2u);
    EXPECT_EQ(json["candela"][1]["gamma"], 120);
    EXPECT_EQ(json["candela"][1]["c"], 0);
    EXPECT_EQ(json["candela"][1]["cd"], 100);
    EXPECT_NE(run("info " + at("lamp.ies")).out.find("1256.64"), std::string::npos);

    write("broken.ies", isotropic.substr(0, isotropic.size() - 4) + "-1\n");
    const Outcome broken = run("info --json " + at("broken.ies"));
    EXPECT_EQ(broken.exitCode, 3);
    EXPECT_TRUE(broken.out.empty());
    EXPECT_NE(broken.err.find("broken.ies:7: candela must not be negative"), std::string::npos) << broken.err;
    EXPECT_EQ(run("info " + at("missing.ldt")).exitCode, 3);
    for (const char* direction : {"30", "200,0", "x,0", "1,2,3", "nan,0"})
        EXPECT_EQ(run("info " + at("lamp.ies") + " --candela " + direction).exitCode, 2) << direction;
    EXPECT_EQ(run("info primitives --candela 0,0").exitCode, 2);
}

TEST_F(CommandTest, InfoTellsWhereTheSunStands) {
    const Outcome outcome = run("info --sun -33.8688,151.2093,2026-12-21T13:00+11:00 --json");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_NEAR(double(json["azimuth_deg"]), 351.220, 0.003);
    EXPECT_NEAR(double(json["altitude_deg"]), 79.455, 0.003);
    EXPECT_NEAR(double(json["refracted_altitude_deg"]), 79.458, 0.003);
    EXPECT_GT(double(json["diameter_deg"]), 0.524);
    EXPECT_GT(double(json["lux"]), 90000);
    for (const char* place :
         {"91,0,2026-06-21T12:00Z", "51,0,2026-06-21T12:00", "51,0,2026-06-21T00:00Z", "here"}) {
        const Outcome wrong = run(std::string("info --json --sun ") + place);
        EXPECT_EQ(wrong.exitCode, 3) << place;
        EXPECT_TRUE(wrong.out.empty()) << place;
        EXPECT_EQ(run("render two-boxes -t hard --size 8x8 -o " + at("a.png") + " --sun " + place).exitCode,
                  3);
        EXPECT_FALSE(fs::exists(at("a.png"))) << place;
    }
    EXPECT_EQ(run("info").exitCode, 2);
    EXPECT_EQ(run("info two-boxes --north 20").exitCode, 2);
}

}  // namespace
}  // namespace penumbra::studio
