// SPDX-License-Identifier: Apache-2.0
// How the command is used: what it lists, refuses, and says where something is wrong.
#include <nlohmann/json.hpp>

#include "studio/image/image_io.h"
#include "tests/support/command_test.h"

namespace penumbra::studio {
namespace {

TEST_F(CommandTest, ListsWhatThereIs) {
    const Outcome techniques = run("list techniques");
    EXPECT_EQ(techniques.exitCode, 0);
    EXPECT_NE(techniques.out.find("hard"), std::string::npos);
    EXPECT_NE(techniques.out.find("reference"), std::string::npos);
    EXPECT_NE(run("list scenes").out.find("primitives"), std::string::npos);
    EXPECT_EQ(run("list devices").exitCode, 0);
}

TEST_F(CommandTest, WrongUseExitsWithTwo) {
    for (const char* arguments : {"",
                                  "paint",
                                  "render",
                                  "render primitives",
                                  "render primitives -o x.png --size 0x10",
                                  "render primitives -o x.png --size big",
                                  "render primitives -o x.png -t harder",
                                  "render primitives -o x.png -t hard --set map_size=x",
                                  "render primitives -o x.png -t hard --set mapsize=1",
                                  "render primitives -o x.png -t hard --set map_size",
                                  "render primitives -o x.jpg",
                                  "render primitives -o x.png --size 99999999x2",
                                  "render primitives --visibility v.png",
                                  "render primitives -o x.png --camera nowhere",
                                  "render primitives -o x.png --frames 5-1",
                                  "render primitives -o x.png --unknown",
                                  "compare primitives -t hard,harder",
                                  "list",
                                  "compare primitives --samples 1",
                                  "render primitives -o x.png --time nan",
                                  "render primitives -o x.png --time inf",
                                  "render primitives -o x.png --frames 1-2 --fps nan",
                                  "render primitives -o x.png --frames 1-2 --fps 0",
                                  "render primitives -o x.png -t exact:samples",
                                  "render primitives -o x.png -t exact:samples=no",
                                  "compare primitives -t exact,exact",
                                  "compare primitives -t hard --set exact.samples=16",
                                  "list techniques exactly",
                                  "list paints",
                                  "list parameters exactly",
                                  "bench primitives --axes maps"}) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 2) << arguments << "\n" << outcome.err;
        EXPECT_FALSE(outcome.err.empty()) << arguments;
    }
}

TEST_F(CommandTest, WrongCamerasAndTechniquesOfLightsExitWithTwo) {
    for (const char* arguments :
         {"--look-from=1,2,3", "--look-at=1,2,3", "--look-from=1,2 --look-at=0,0,0",
          "--look-from=1,2,3,4 --look-at=0,0,0", "--look-from=1,2,inf --look-at=0,0,0",
          "--look-from=0,0,0 --look-at=0,0,0", "--look-from=1,2,3 --look-at=0,0,0 --fov 180",
          "--look-from=1,2,3 --look-at=0,0,0 --camera 0", "--fov 30",
          "--look-from=1,2,3 --look-at=0,0,0 --fov 30 --ortho-height 2", "--technique-of key",
          "--technique-of nobody=hard", "--technique-of key=harder", "--set pcf.radius=2"}) {
        const Outcome outcome = run("render primitives -t hard --size 8x8 -o " + at("a.png ") + arguments);
        EXPECT_EQ(outcome.exitCode, 2) << arguments << "\n" << outcome.err;
        EXPECT_FALSE(fs::exists(at("a.png"))) << arguments;
    }
}

TEST_F(CommandTest, UnknownTechniqueIsAnsweredWithTheKnownOnes) {
    const Outcome outcome = run("render primitives -t exactly -o " + at("a.png"));
    EXPECT_EQ(outcome.exitCode, 2);
    EXPECT_NE(outcome.err.find("exactly"), std::string::npos);
    EXPECT_NE(outcome.err.find("reference"), std::string::npos);
}

TEST_F(CommandTest, WhatIsMisspeltIsAnsweredWithTheNearest) {
    const std::vector<std::pair<std::string, std::string>> misspelt = {
        {"comprae primitives", "compare"},           {"list tecniques", "techniques"},
        {"list techniques smothies", "smoothies"},   {"render primitives -o x.png -t exat", "exact"},
        {"bench primitives --axes light", "lights"}, {"compare primitives --flicker camra", "camera"},
        {"reproduce kirsch2013 -o x", "kirsch2003"}};
    for (const auto& [arguments, meant] : misspelt) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 2) << arguments << "\n" << outcome.err;
        EXPECT_NE(outcome.err.find("did you mean '" + meant + "'"), std::string::npos) << outcome.err;
    }
}

TEST_F(CommandTest, ParametersAreListedAndCanAllBeSet) {
    const Outcome listed = run("list techniques exact");
    ASSERT_EQ(listed.exitCode, 0) << listed.err;
    EXPECT_NE(listed.out.find("samples=64"), std::string::npos) << listed.out;
    EXPECT_EQ(listed.out.find("map_size"), std::string::npos) << "no other technique was asked for";

    const Outcome all = run("list parameters --json");
    ASSERT_EQ(all.exitCode, 0) << all.err;
    const auto json = nlohmann::json::parse(all.out);
    EXPECT_GE(json.at("techniques").size(), 2u);
    for (const auto& technique : json.at("techniques")) {
        for (const auto& parameter : technique.at("parameters")) {
            EXPECT_FALSE(parameter.at("help").get<std::string>().empty()) << parameter;
            EXPECT_TRUE(parameter.contains("unit") && parameter.contains("default")) << parameter;
            const std::string type = parameter.at("type");
            EXPECT_EQ(parameter.contains("min"), type == "integer" || type == "real") << parameter;
            EXPECT_EQ(parameter.contains("choices"), type == "choice") << parameter;
        }
    }
    // What is printed as a default is taken as a value.
    const auto& hard = json.at("techniques").at(0);
    std::string set;
    for (const auto& parameter : hard.at("parameters")) {
        set += " --set " + parameter.at("name").get<std::string>() + "=" +
               parameter.at("default").get<std::string>();
    }
    const Outcome outcome = run("render half-plane --size 8x8 -o " + at("a.png") + " -t " +
                                hard.at("technique").get<std::string>() + set);
    EXPECT_EQ(outcome.exitCode, 0) << set << outcome.err;
}

TEST_F(CommandTest, ResultsThatDoNotArriveExitWithFive) {
    const auto exitCode = [&](const std::string& line) {
        const int status = std::system((line + " 2>" + at("stderr")).c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    };
    const std::string command = PENUMBRA_COMMAND;
    for (const std::string arguments :
         {" list techniques", " list scenes", " --help", " info primitives", " --version"}) {
        EXPECT_EQ(exitCode(command + arguments + " >/dev/full"), 5) << arguments;
        EXPECT_EQ(exitCode(command + arguments + " >&-"), 5) << arguments;
        EXPECT_NE(readText(at("stderr")).find("standard output"), std::string::npos) << arguments;
    }
    // A reader that has gone: the exit code is that of the command, and no signal's.
    EXPECT_EQ(exitCode("{ " + command + " render half-plane -t hard --size 8x8 --json; echo $? >" +
                       at("code") + "; } | true"),
              0);
    EXPECT_EQ(readText(at("code")), "5\n");
    // Nothing was to be printed, so nothing is lost.
    EXPECT_EQ(exitCode(command + " render half-plane -t hard --size 8x8 -o " + at("a.png") + " >&-"), 0);
    EXPECT_EQ(readPng(at("a.png")).image.width_px, 8);
}

TEST_F(CommandTest, TheCommandInAPictureIsOneThatAShellReads) {
    fs::create_directory(at("it's"));
    const std::string file = at("it's/a.png");
    ASSERT_EQ(run("render half-plane -t hard --size 8x8 -o \"" + file + "\"").exitCode, 0);
    const std::string line = readPng(file).metadata.at("penumbra:command");
    fs::remove(file);
    const std::string again = PENUMBRA_COMMAND + line.substr(std::string("penumbra").size());
    EXPECT_EQ(std::system(again.c_str()), 0) << line;
    EXPECT_TRUE(fs::exists(file)) << line;
}

TEST_F(CommandTest, BadInputExitsWithThree) {
    write("broken.gltf", "{\"asset\": {\"version\": \"2.0\"}, \"nodes\": [{\"mesh\": 7}]}");
    write("lights.json",
          "{\"version\": 1, \"lights\": [{\"name\": \"a\", \"type\": \"SphereLight\", \"radus\": 1}]}");
    for (const std::string& arguments :
         {std::string("render /nonexistent.glb -o a.png"), "render primitivs -o " + at("a.png"),
          "render " + at("broken.gltf") + " -o " + at("a.png"),
          "render primitives -o " + at("a.png") + " --lights " + at("lights.json"),
          "render primitives -o " + at("a.png") + " --lights " + at("missing.json"),
          "info " + folder.string()}) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 3) << arguments << "\n" << outcome.err;
        EXPECT_FALSE(fs::exists(at("a.png"))) << arguments;
    }
    EXPECT_NE(run("render primitives -o a.png --lights " + at("lights.json")).err.find("radius"),
              std::string::npos)
        << "the right name is suggested";
}

TEST_F(CommandTest, MissingDeviceExitsWithFour) {
    EXPECT_EQ(run("render primitives -o " + at("a.png") + " --device 1000").exitCode, 4);
}

TEST_F(CommandTest, UnwritableOutputExitsWithFive) {
    EXPECT_EQ(run("render primitives --size 32x32 -t hard -o " + at("missing/a.png")).exitCode, 5);
    fs::create_directory(at("taken.png"));
    const Outcome outcome = run("render primitives --size 32x32 -t hard -o " + at("taken.png"));
    EXPECT_EQ(outcome.exitCode, 5) << outcome.err;
    write("file", "");
    EXPECT_EQ(run("compare primitives --size 32x32 -t hard -o " + at("file")).exitCode, 5);
    EXPECT_EQ(files(), (std::vector<std::string>{"file", "taken.png"})) << "nothing half-written is left";
}

TEST_F(CommandTest, ReproduceRefusesWhatItDoesNotKnow) {
    const Outcome paper = run("reproduce kajiya1986 -o " + at("out"));
    EXPECT_EQ(paper.exitCode, 2);
    EXPECT_NE(paper.err.find("kirsch2003"), std::string::npos) << paper.err;
    EXPECT_EQ(run("reproduce thesis -o " + at("out") + " --models " + at("nowhere")).exitCode, 3);
    EXPECT_TRUE(files().empty()) << "nothing half-written";
}

}  // namespace
}  // namespace penumbra::studio
