// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "apps/penumbra/arguments.h"
#include "apps/penumbra/commands.h"
#include "studio/workbench/progress.h"

namespace penumbra::studio {
namespace {

struct BenchArguments {
    SceneArguments scene;
    std::string techniques = "all";
    std::vector<std::string> settings;
    int rounds = 15;
    bool json = false;
};

/// A technique and all its times: one a round, every light together.
struct Contender {
    std::string name;
    std::unique_ptr<Technique> technique;
    std::vector<double> milliseconds;
    std::vector<double> ratios;  ///< to `hard` in the same round
    Statistics statistics;       ///< of the last light
};

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::ranges::nth_element(values, values.begin() + std::ptrdiff_t(values.size() / 2));
    return values[values.size() / 2];
}

void printTable(const std::vector<Contender>& contenders, const std::string& renderer) {
    fmt::print("{:<14} {:>10} {:>8}   passes (ms)\n", "technique", "ms", "x hard");
    for (const Contender& contender : contenders) {
        std::string passes;
        for (const PassTime& pass : contender.statistics.passes) {
            passes += fmt::format("{} {:.2f}  ", pass.name, pass.milliseconds);
        }
        fmt::print("{:<14} {:>10.3f} {:>8.2f}   {}\n", contender.name, median(contender.milliseconds),
                   median(contender.ratios), passes);
    }
    fmt::print("on {}\n", renderer);
}

void printJson(const std::vector<Contender>& contenders, const BenchArguments& arguments, PictureSize size,
               const std::string& renderer) {
    nlohmann::ordered_json json = {{"scene", arguments.scene.scene},
                                   {"size", {size.width_px, size.height_px}},
                                   {"renderer", renderer},
                                   {"rounds", arguments.rounds},
                                   {"results", nlohmann::json::array()}};
    for (const Contender& contender : contenders) {
        nlohmann::ordered_json passes = nlohmann::json::object();
        for (const PassTime& pass : contender.statistics.passes)
            passes[std::string(pass.name)] = pass.milliseconds;
        const auto [low, high] = std::ranges::minmax(contender.milliseconds);
        json["results"].push_back(
            {{"technique", contender.name},
             {"ms", {{"median", median(contender.milliseconds)}, {"min", low}, {"max", high}}},
             {"ratio_to_hard", median(contender.ratios)},
             {"passes_ms", std::move(passes)}});
    }
    std::cout << json.dump(2) << "\n";
}

/// Rounds in which every contender renders once, so that a drift of the machine's speed meets all alike.
void bench(const BenchArguments& arguments) {
    const PictureSize size = arguments.scene.pictureSize();
    std::vector<std::string> names = techniqueNames(arguments.techniques);
    std::erase(names, "hard");
    names.insert(names.begin(), "hard");
    const Scene scene = arguments.scene.open();
    const SceneMoment moment = scene.at(arguments.scene.time_s);
    const Camera& camera = findCamera(moment, arguments.scene.camera);
    Workbench workbench(arguments.scene.device);
    workbench.requireSize(size);
    workbench.open(scene);

    std::vector<Contender> contenders;
    for (const std::string& name : names) {
        contenders.push_back({name, workbench.makeTechnique(name), {}, {}, {}});
        if (name != "hard") applySettings(*contenders.back().technique, arguments.settings);
    }
    Progress progress("bench");
    constexpr int warmUp = 2;
    for (int round = -warmUp; round < arguments.rounds; ++round) {
        progress.update(double(round + warmUp) / (arguments.rounds + warmUp));
        for (Contender& contender : contenders) {
            const TechniqueResult result =
                workbench.run(contender.name, *contender.technique, moment, camera, size, 1);
            double sum = 0;
            for (const LightResult& light : result.lights) sum += light.milliseconds.front();
            if (!result.lights.empty()) contender.statistics = result.lights.back().statistics;
            if (round < 0) continue;
            contender.milliseconds.push_back(sum);
            contender.ratios.push_back(sum / contenders.front().milliseconds.back());
        }
    }
    if (arguments.json) {
        printJson(contenders, arguments, size, workbench.device().renderer());
    } else {
        printTable(contenders, workbench.device().renderer());
    }
}

}  // namespace

void addBench(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("bench", "what techniques cost, as ratios to hard in the same run");
    auto arguments = std::make_shared<BenchArguments>();
    arguments->scene.addTo(*command);
    command->add_option("-t,--technique", arguments->techniques, "NAME,NAME or all")->capture_default_str();
    command
        ->add_option("--set", arguments->settings,
                     "KEY=VALUE: a parameter of the techniques other than hard; may be repeated")
        ->take_all();
    command->add_option("--rounds", arguments->rounds, "measured rounds")
        ->capture_default_str()
        ->check(CLI::Range(1, 10000));
    command->add_flag("--json", arguments->json, "print the result as JSON instead of a table");
    command->callback([arguments] { bench(*arguments); });
}

}  // namespace penumbra::studio
