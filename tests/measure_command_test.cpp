// SPDX-License-Identifier: Apache-2.0
// `penumbra measure` as a script meets it: what it answers, what it leaves, and what it says of bad input.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/command_test.h"

namespace penumbra::studio {
namespace {

const std::string office = PENUMBRA_SOURCE_DIRECTORY "/examples/office/office.gltf";
const std::string plan = " --plane=-1,0.002,-1,2,2 --grid 6x4 --set samples=64 ";

using MeasureCommandTest = CommandTest;

TEST_F(MeasureCommandTest, AnswersInAllForms) {
    const Outcome table =
        run("measure many-lights" + plan + "--per-light --csv " + at("a.csv") + " -o " + at("a.svg"));
    EXPECT_EQ(table.exitCode, 0) << table.err;
    EXPECT_NE(table.out.find("uniformity"), std::string::npos) << table.out;
    const std::string csv = readText(at("a.csv"));
    EXPECT_EQ(std::ranges::count(csv, '\n'), 25);
    EXPECT_TRUE(csv.starts_with("x,y,z,nx,ny,nz,lux,bound,inside,lux of ")) << csv.substr(0, 200);
    EXPECT_NE(readText(at("a.svg")).find("<svg"), std::string::npos);

    const Outcome json = run("measure many-lights" + plan + "--json -o " + at("a.png"));
    ASSERT_EQ(json.exitCode, 0) << json.err;
    const nlohmann::json report = nlohmann::json::parse(json.out);
    EXPECT_EQ(report["points"].size(), 24u);
    for (const char* key : {"position", "normal", "lux", "bound"})
        EXPECT_TRUE(report["points"][0].contains(key)) << key;
    EXPECT_GT(report["min"].get<double>(), 0);
    EXPECT_NEAR(report["uniformity"].get<double>(),
                report["min"].get<double>() / report["mean"].get<double>(), 1e-5);
    EXPECT_EQ(files(), (std::vector<std::string>{"a.csv", "a.png", "a.svg"}));
}

TEST_F(MeasureCommandTest, PointsOfAListAreThoseOfAGrid) {
    write("p.csv", "x,y,z,nx,ny,nz\n-0.5,0.002,-0.5,0,1,0\n0.5,0.002,0.5,0,3,0\n");
    const Outcome list = run("measure many-lights --points " + at("p.csv") + " --set samples=64 --json");
    const Outcome grid =
        run("measure many-lights --plane=-1,0.002,-1,2,2 --grid 2x2 --set samples=64 --json");
    ASSERT_EQ(list.exitCode, 0) << list.err;
    const auto ofList = nlohmann::json::parse(list.out)["points"],
               ofGrid = nlohmann::json::parse(grid.out)["points"];
    EXPECT_EQ(ofList[0], ofGrid[0]);
    EXPECT_EQ(ofList[1], ofGrid[3]);
}

TEST_F(MeasureCommandTest, TheOfficesEightPanelsAreTheIntegralOfTheirFile) {
    // Where nothing stands in between: candela of panel.ies, linear between its angles, by cos / d^2 over
    // 40 x 40 points of each panel, summed by a script that knows nothing of this program.
    struct Known {
        const char* point;
        double lux;
    };
    const Known known[] = {{"0,0.75,0,0,1,0", 683.79},
                           {"-0.9,0.75,-0.3,0,1,0", 681.01},
                           {"2.9,0.75,0.1,0,1,0", 490.37},
                           {"-3.3,0.75,2.3,0,1,0", 238.90},
                           {"0.3,0,0.2,0,1,0", 590.59}};
    std::string list;
    for (const Known& k : known) list += std::string(k.point) + "\n";
    write("p.csv", list);
    const std::string panels = PENUMBRA_SOURCE_DIRECTORY "/examples/office/panels.lights.json";
    const Outcome outcome = run("measure " + office + " --lights " + panels + " --points " + at("p.csv") +
                                " --set samples=64 --json");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const auto points = nlohmann::json::parse(outcome.out)["points"];
    for (std::size_t i = 0; i < std::size(known); ++i)
        EXPECT_NEAR(double(points[i]["lux"]), known[i].lux, 0.002 * known[i].lux) << known[i].point;
}

TEST_F(MeasureCommandTest, PiecesMergeToTheWhole) {
    const std::string where = "measure many-lights" + plan;
    EXPECT_EQ(run(where + "--csv " + at("whole.csv")).exitCode, 0);
    EXPECT_EQ(run(where + "--rows 1-2 --csv " + at("1.csv")).exitCode, 0);
    EXPECT_EQ(run(where + "--rows 3-4 --csv " + at("2.csv")).exitCode, 0);
    const Outcome merged =
        run(where + "--merge " + at("2.csv") + " " + at("1.csv") + " --csv " + at("merged.csv"));
    EXPECT_EQ(merged.exitCode, 0) << merged.err;
    EXPECT_EQ(readText(at("merged.csv")), readText(at("whole.csv")));
}

TEST_F(MeasureCommandTest, PointsInFurnitureAreNamedAndLeftOut) {
    // In the middle of a desk's top.
    const Outcome outcome =
        run("measure " + office + " --plane=-2.7,0.72,-1.7,1.6,0.8 --grid 4x2 --set samples=16 --json");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const nlohmann::json report = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(report["inside"]["desk 1"], 8);
    EXPECT_TRUE(report["min"].is_null());
    EXPECT_EQ(report["points"][0]["inside"], "desk 1");
    EXPECT_NE(outcome.err.find("inside of bodies"), std::string::npos) << outcome.err;
}

TEST_F(MeasureCommandTest, IsTheSameFarFromTheOrigin) {
    // The office, and its light, at 10,000 km to the east.
    constexpr double far_m = 1e7;
    nlohmann::json scene = nlohmann::json::parse(readText(office));
    for (nlohmann::json& node : scene["nodes"]) {
        nlohmann::json place = node.value("translation", nlohmann::json{0, 0, 0});
        place[0] = place[0].get<double>() + far_m;
        node["translation"] = place;
    }
    write("far.gltf", scene.dump());
    const auto lights = [](double x) {
        return nlohmann::json{{"version", 1},
                              {"lights",
                               {{{"name", "key"},
                                 {"type", "RectLight"},
                                 {"width", 1},
                                 {"height", 1},
                                 {"intensity", 5000},
                                 {"translation", {x, 2.7, 0}},
                                 {"rotation", {-0.7071068, 0, 0, 0.7071068}}}}}}
            .dump();
    };
    write("near.lights.json", lights(0));
    write("far.lights.json", lights(far_m));
    const auto measure = [&](const std::string& name, const std::string& lightsFile, const std::string& x) {
        const Outcome outcome = run("measure " + name + " --lights " + at(lightsFile) + " --plane=" + x +
                                    ",0.745,-2,5,4 --grid 10x8 --set samples=64 --json");
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return nlohmann::json::parse(outcome.out)["points"];
    };
    const auto near = measure(office, "near.lights.json", "-2.5");
    const auto far = measure(at("far.gltf"), "far.lights.json", "9999997.5");
    ASSERT_EQ(near.size(), far.size());
    for (std::size_t i = 0; i < near.size(); ++i) {
        ASSERT_EQ(near[i]["lux"].is_null(), far[i]["lux"].is_null()) << i;
        if (near[i]["lux"].is_null()) continue;
        const double expected = near[i]["lux"].get<double>();
        EXPECT_NEAR(far[i]["lux"].get<double>(), expected, 0.01 * expected + 0.5) << i;
    }
}

TEST_F(MeasureCommandTest, ADayHasLuxAndHours) {
    const Outcome outcome = run("measure " + office +
                                " --sun=52.52,13.405,2026-03-20T00:00+01:00 --over 11:00-14:00/30min "
                                "--plane=-3,0.8,-2,6,4 --grid 6x4 --set samples=16 --json --csv " +
                                at("day.csv") + " -o " + at("day.png"));
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const nlohmann::json report = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(report["times"].size(), 7u);
    double longest = 0, shortest = 1e9;
    for (const nlohmann::json& point : report["points"]) {
        if (point["lux"].is_null()) continue;
        EXPECT_EQ(point["lux_at"].size(), 7u);
        longest = std::max(longest, point["sun_hours"].get<double>());
        shortest = std::min(shortest, point["sun_hours"].get<double>());
    }
    EXPECT_GT(longest, 0.4);
    EXPECT_LE(longest, 3);
    EXPECT_EQ(shortest, 0);
    EXPECT_NE(readText(at("day.csv")).find("sun_hours,lux at 11:00"), std::string::npos);
}

TEST_F(MeasureCommandTest, WhatIsInterruptedLeavesNothing) {
    for (const char* signal : {"INT", "TERM"}) {
        const std::string command = std::string("timeout -s ") + signal + " 1 " PENUMBRA_COMMAND " measure " +
                                    office + " --plane=-3,0.8,-2,6,4 --grid 1000x1000 --csv " + at("a.csv") +
                                    " -o " + at("a.png") + " >" + at("stdout") + " 2>" + at("stderr");
        EXPECT_NE(std::system(command.c_str()), 0) << "a million points in a second";
        EXPECT_EQ(files(), std::vector<std::string>{}) << signal;
        EXPECT_EQ(readText(at("stdout")), "") << signal;
    }
}

/// Arguments after the scene, and what the message must hold.
struct Refusal {
    int exitCode;
    std::string arguments, message;
};

TEST_F(MeasureCommandTest, TellsWhatIsWrongAndLeavesNothing) {
    write("short.csv", "x,y,z,nx,ny,nz\n0,1,0,0,1,0\n0,1,0\n");
    write("nan.csv", "0,1,nan,0,1,0\n");
    write("zero.csv", "0,1,0,0,0,0\n");
    const std::string plane = "--plane=-1,0.01,-1,2,2 ", sun = "--sun=52.52,13.405,2026-03-20T12:00";
    const std::vector<Refusal> refusals = {
        {3, plane + "--grid 100000x10000", "--grid: 100000x10000 points"},
        {3, plane + "--grid 99999999999999x1", "--grid: "},
        {3, plane + "--grid 0x3", "--grid: "},
        {3, "--plane=500,0.01,-1,2,2 --grid 3x3", "beside the scene"},
        {3, "--plane=-1,0.01,-1,0,2 --grid 3x3", "no extent"},
        {3, "--plane=-1,nan,-1,2,2 --grid 3x3", "not finite"},
        {3, "--surface grond --grid 3x3", "did you mean 'ground'"},
        {3, "--points " + at("short.csv"), "short.csv:3: 3 columns"},
        {3, "--points " + at("nan.csv"), "nan.csv:1: z is not finite"},
        {3, "--points " + at("zero.csv"), "zero.csv:1: the normal has no length"},
        {3, "--points " + at("nowhere.csv"), "nowhere.csv: cannot be read"},
        {3, plane + "--grid 3x3 --over 08:00-18:00", "which sun"},
        {3, plane + "--grid 3x3 --over 08:00-18:00 " + sun, "no zone"},
        {3, plane + "--grid 3x3 --over 01:00-03:00 " + sun + "+01:00", "below the horizon"},
        {3, plane + "--grid 3x3 --over 18:00-08:00 " + sun + "+01:00", "before it begins"},
        {3, plane + "--grid 3x3 --rows 2-9", "rows 1 to 3"},
        {3, plane + "--grid 3x3 --merge " + at("nowhere.csv"), "cannot be read"},
        {3, plane + "--grid 3x3 --merge " + at("short.csv"), "short.csv:1: its columns"},
        {2, "", "where?"},
        {2, plane, "--grid"},
        {2, plane + "--grid 3", "NxM"},
        {2, plane + "--grid 3x3 --rows 2", "FIRST-LAST"},
        {2, "--plane=1,2,3 --grid 3x3", "X,Y,Z,WIDTH,DEPTH"},
        {2, plane + "--grid 3x3 -o plan.jpg", ".png or .svg"},
        {2, plane + "--grid 3x3 -t hard", "needs a picture"},
        {2, plane + "--grid 3x3 -t hardd", "did you mean 'hard'"},
        {2, plane + "--grid 3x3 --set sampels=3", "sampels"},
        {2, "--points " + at("short.csv") + " -o " + at("plan.png"), "has no plan"},
        {5, plane + "--grid 3x3 --csv /nowhere/at/all.csv", "is no folder"},
    };
    for (const auto& [exitCode, arguments, message] : refusals) {
        const Outcome outcome = run("measure many-lights " + arguments);
        EXPECT_EQ(outcome.exitCode, exitCode) << arguments << "\n" << outcome.err;
        EXPECT_NE(outcome.err.find(message), std::string::npos) << arguments << "\n" << outcome.err;
        EXPECT_EQ(outcome.out, "") << arguments;
    }
    EXPECT_EQ(files(), (std::vector<std::string>{"nan.csv", "short.csv", "zero.csv"}));
}

}  // namespace
}  // namespace penumbra::studio
