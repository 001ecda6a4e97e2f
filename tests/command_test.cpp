// SPDX-License-Identifier: Apache-2.0
// The command as a script meets it: exit codes, messages, files, JSON.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

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

TEST_F(CommandTest, ACameraOfOnesOwnSeesWhatTheScenesSees) {
    // The second camera of the closed-form scenes is not needed: this one is placed where --look-from can say
    // it.
    const std::string render = "render half-plane -t hard --size 32x32 ";
    ASSERT_EQ(
        run(render + "--look-from=0,3,0.001 --look-at=0,0,0 --ortho-height 2 -o " + at("a.png")).exitCode, 0);
    ASSERT_EQ(
        run(render + "--look-from=0,9,0.003 --look-at=0,0,0 --ortho-height 2 -o " + at("b.png")).exitCode, 0);
    // Without perspective it does not matter from how far one looks.
    EXPECT_EQ(readPng(at("a.png")).image.values, readPng(at("b.png")).image.values);
    ASSERT_EQ(run(render + "--look-from=0,3,0.001 --look-at=0,0,0 --fov 20 -o " + at("c.png")).exitCode, 0);
    EXPECT_NE(readPng(at("a.png")).image.values, readPng(at("c.png")).image.values);
}

TEST_F(CommandTest, ALightMayHaveATechniqueOfItsOwn) {
    const std::string render = "render half-plane -t hard --size 32x32 ";
    ASSERT_EQ(run(render + "--technique-of key=pcf --set pcf.map_size=64 -o " + at("a.png")).exitCode, 0);
    ASSERT_EQ(run("render half-plane -t pcf --set map_size=64 --size 32x32 -o " + at("b.png")).exitCode, 0);
    ASSERT_EQ(run(render + "-o " + at("c.png")).exitCode, 0);
    EXPECT_EQ(readPng(at("a.png")).image.values, readPng(at("b.png")).image.values);
    EXPECT_NE(readPng(at("a.png")).image.values, readPng(at("c.png")).image.values);
}

double meanOf(const Image& image) {
    return std::accumulate(image.values.begin(), image.values.end(), 0.0) / double(image.values.size());
}

TEST_F(CommandTest, ExposureIsAutomaticAValueOrAnotherPictures) {
    const std::string render = "render half-plane -t hard --size 32x32 ";
    ASSERT_EQ(run(render + "-o " + at("auto.png")).exitCode, 0);
    const Metadata metadata = readPng(at("auto.png")).metadata;
    ASSERT_TRUE(metadata.contains("penumbra:exposure_ev"));
    const double ev = std::stod(metadata.at("penumbra:exposure_ev"));
    ASSERT_EQ(run(render + "--exposure " + std::to_string(ev + 1) + " -o " + at("darker.png")).exitCode, 0);
    EXPECT_LT(meanOf(readPng(at("darker.png")).image), 0.9 * meanOf(readPng(at("auto.png")).image));
    ASSERT_EQ(run(render + "--exposure lock=" + at("auto.png") + " -o " + at("locked.png")).exitCode, 0);
    const Image locked = readPng(at("locked.png")).image, automatic = readPng(at("auto.png")).image;
    for (std::size_t i = 0; i < locked.values.size(); ++i)
        ASSERT_NEAR(locked.values[i], automatic.values[i], 1.01 / 255);
    ASSERT_EQ(run(render + "--exposure lock=" + at("auto.png") + " -o " + at("linear.exr")).exitCode, 0);
    EXPECT_EQ(run(render + "--exposure lock=" + at("linear.exr") + " -o " + at("again.png")).exitCode, 0);
}

TEST_F(CommandTest, WrongExposuresAreRefused) {
    const std::string render = "render half-plane -t hard --size 8x8 -o " + at("a.png") + " --exposure ";
    for (const char* wrong : {"bright", "nan", "41", "lock", "1e"})
        EXPECT_EQ(run(render + wrong).exitCode, 2) << wrong;
    EXPECT_EQ(run(render + "lock=" + at("nothing.png")).exitCode, 3);
    writePng(at("plain.png"), Image(4, 4, 3, 0.5f));
    const Outcome outcome = run(render + "lock=" + at("plain.png"));
    EXPECT_EQ(outcome.exitCode, 3);
    EXPECT_NE(outcome.err.find("does not say how it was exposed"), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(at("a.png")));
}

TEST_F(CommandTest, AntialiasingAveragesSamplesOfVisibility) {
    const std::string render = "render two-boxes -t hard --size 32x32 --visibility ";
    const auto between = [&](const std::string& file) {
        const Image seen = imageOf(readExr(file), "V");
        return std::ranges::count_if(seen.values, [](float v) { return v > 0 && v < 1; });
    };
    ASSERT_EQ(run(render + at("plain.exr")).exitCode, 0);
    ASSERT_EQ(run(render + at("smooth.exr") + " --antialias 4 -o " + at("smooth.png")).exitCode, 0);
    EXPECT_EQ(between(at("plain.exr")), 0);
    EXPECT_GT(between(at("smooth.exr")), 16);
    EXPECT_EQ(readPng(at("smooth.png")).image.width_px, 32);
    for (const char* wrong : {"0", "9", "-1", "x"})
        EXPECT_EQ(run(render + at("b.exr") + " --antialias " + wrong).exitCode, 2) << wrong;
    EXPECT_EQ(run("render half-plane -t hard --size 8192x8 --antialias 8 -o " + at("c.png")).exitCode, 2);
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

TEST_F(CommandTest, RendersPictureAndVisibility) {
    const Outcome outcome = run("render many-lights -t hard --size 48x32 -o " + at("a.png") +
                                " --visibility " + at("v.exr") + " --json");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(files(), (std::vector<std::string>{"a.png", "v.exr"}));
    const PngPicture picture = readPng(at("a.png"));
    EXPECT_EQ(picture.image.width_px, 48);
    EXPECT_EQ(picture.image.height_px, 32);
    EXPECT_NE(picture.metadata.at("penumbra:command").find("many-lights"), std::string::npos);
    const ExrPicture visibility = readExr(at("v.exr"));
    EXPECT_EQ(visibility.channels.size(), 5u);
    EXPECT_TRUE(visibility.channels.front().name.ends_with(".V")) << visibility.channels.front().name;
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json.at("lights").size(), 5u);
}

TEST_F(CommandTest, WithoutATechniqueAutoIsTaken) {
    const auto visibility = [&](const std::string& file, const std::string& flags) {
        const Outcome outcome =
            run("render two-boxes --size 32x24 -o " + at("a.png") + " --visibility " + at(file) + flags);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return readExr(at(file)).channels.at(0).values;
    };
    const std::vector<float> automatic = visibility("auto.exr", " -t auto");
    EXPECT_EQ(visibility("default.exr", ""), automatic);
    EXPECT_EQ(visibility("asked.exr", " --error 0.02"), automatic);
    EXPECT_NE(visibility("hard.exr", " -t hard"), automatic) << "this scene does not tell techniques apart";
    EXPECT_NE(run("render --help").out.find("auto"), std::string::npos);
}

TEST_F(CommandTest, AnErrorOrATimeThatCannotBeKeptIsRefused) {
    const auto refusal = [&](const std::string& flags) {
        const Outcome outcome = run("render two-boxes --size 32x24 -o " + at("a.png") + " " + flags);
        EXPECT_NE(outcome.exitCode, 0) << flags;
        EXPECT_FALSE(std::filesystem::exists(at("a.png"))) << flags;
        return outcome.err;
    };
    for (const char* error : {"0", "-1", "nan", "1.5"}) {
        EXPECT_NE(refusal(std::string("--error=") + error).find("--error"), std::string::npos) << error;
    }
    for (const char* budget : {"0", "-1", "nan"}) {
        EXPECT_NE(refusal(std::string("--budget-ms=") + budget).find("--budget-ms"), std::string::npos)
            << budget;
    }
    EXPECT_NE(refusal("--error 0.00001").find("no technique promises less than 0.0"), std::string::npos);
    EXPECT_NE(refusal("-t pcss --error 0.01").find("the smallest that 'pcss' can promise is 0."),
              std::string::npos);
    EXPECT_NE(refusal("-t smoothies --error 0.01").find("'smoothies' promises no error"), std::string::npos);
    EXPECT_NE(refusal("-t exact --budget-ms 5").find("'-t auto' keeps to a time"), std::string::npos);
}

TEST_F(CommandTest, WhatWasChosenIsTold) {
    const Outcome outcome = run("render two-boxes --size 32x24 --error 0.03 --json");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const auto statistics = nlohmann::json::parse(outcome.out).at("lights").at(0).at("statistics");
    EXPECT_TRUE(statistics.at("chosen").contains("technique"));
    EXPECT_LE(statistics.at("counts").at("error promised").get<double>(), 0.03);
    const Outcome named = run("render two-boxes --size 32x24 -t exact --error 0.03 --json");
    EXPECT_EQ(named.exitCode, 0) << named.err;
    EXPECT_FALSE(nlohmann::json::parse(named.out).at("lights").at(0).at("statistics").contains("chosen"));
}

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

TEST_F(CommandTest, WithABudgetThePictureIsTheSteadyStates) {
    // Far too little time: the error has given way when the picture is made, and both are told.
    const Outcome outcome = run("compare two-boxes -t auto --size 32x24 --samples 16 --budget-ms 0.001");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("budget 0.001 ms, spent "), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("the budget gave way"), std::string::npos) << outcome.out;
    const Outcome refused = run("render two-boxes --size 32x24 --json --error 0.00001 --budget-ms 0.001");
    EXPECT_NE(refused.exitCode, 0) << "neither can be kept";
    EXPECT_NE(refused.err.find("no technique promises less than"), std::string::npos) << refused.err;
}

TEST_F(CommandTest, OneLightsVisibilityIsChannelV) {
    ASSERT_EQ(run("render two-boxes -t hard --size 32x32 --visibility " + at("v.exr")).exitCode, 0);
    EXPECT_EQ(readExr(at("v.exr")).channels.front().name, "V");
}

TEST_F(CommandTest, ExrIsLinearRadiance) {
    ASSERT_EQ(run("render two-boxes -t hard --size 32x32 -o " + at("a.exr")).exitCode, 0);
    const ExrPicture picture = readExr(at("a.exr"));
    ASSERT_EQ(picture.channels.size(), 3u);
    EXPECT_GT(std::ranges::max(picture.channels.front().values), 10) << "nits";
}

TEST_F(CommandTest, FramesAreNumberedAndCanBeTakenUpAgain) {
    const std::string render = "render moving -t hard --size 32x24 --frames 1-5x2 --skip-existing -o ";
    ASSERT_EQ(run(render + at("f.####.png")).exitCode, 0);
    EXPECT_EQ(files(), (std::vector<std::string>{"f.0001.png", "f.0003.png", "f.0005.png"}));
    EXPECT_NE(readText(at("f.0001.png")), readText(at("f.0005.png"))) << "it moves";

    fs::remove(at("f.0003.png"));
    write("f.0001.png", "kept");
    ASSERT_EQ(run(render + at("f.####.png")).exitCode, 0);
    EXPECT_EQ(readText(at("f.0001.png")), "kept");
    EXPECT_TRUE(fs::exists(at("f.0003.png")));
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

TEST_F(CommandTest, ReproduceRefusesWhatItDoesNotKnow) {
    const Outcome paper = run("reproduce kajiya1986 -o " + at("out"));
    EXPECT_EQ(paper.exitCode, 2);
    EXPECT_NE(paper.err.find("kirsch2003"), std::string::npos) << paper.err;
    EXPECT_EQ(run("reproduce thesis -o " + at("out") + " --models " + at("nowhere")).exitCode, 3);
    EXPECT_TRUE(files().empty()) << "nothing half-written";
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

TEST_F(CommandTest, SceneWithoutTrianglesIsAPicture) {
    write("empty.gltf", "{\"asset\": {\"version\": \"2.0\"}, \"scenes\": [{}], \"scene\": 0}");
    const Outcome outcome = run("render " + at("empty.gltf") + " -t hard --size 32x32 -o " + at("a.png"));
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_TRUE(fs::exists(at("a.png")));
}

TEST_F(CommandTest, LightsFileReplacesTheScenesLights) {
    write(
        "sun.json",
        R"({"version": 1, "lights": [{"name": "sun", "type": "DistantLight", "angle": 0.53, "intensity": 50000}]})");
    const Outcome outcome = run("info two-boxes --lights " + at("sun.json"));
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("sun: DistantLight of 0.53 degrees"), std::string::npos) << outcome.out;
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
