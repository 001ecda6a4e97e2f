// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "apps/penumbra/arguments.h"
#include "apps/penumbra/commands.h"
#include "studio/bench/contest.h"
#include "studio/workbench/progress.h"

namespace penumbra::studio {
namespace {

struct BenchArguments {
    SceneArguments scene;
    std::string techniques = "all";
    std::vector<std::string> settings;
    int rounds = 15;
    bool still = false;
    bool json = false;
};

void printTable(const std::vector<ContestResult>& results, const Workbench& workbench) {
    fmt::print("{:<14} {:>10} {:>19} {:>8} {:>9}   passes (ms)\n", "technique", "ms", "quartiles", "x hard",
               "MB");
    for (const ContestResult& result : results) {
        std::string passes;
        for (const auto& [name, ms] : result.passes_ms) passes += fmt::format("{} {:.2f}  ", name, ms);
        fmt::print("{:<14} {:>10.3f} {:>9.3f} {:>9.3f} {:>8.2f} {:>9.2f}   {}\n", result.contender.label,
                   result.cost_ms.median, result.cost_ms.low, result.cost_ms.high, result.ratio.median,
                   1e-6 * double(result.memory_bytes), passes);
    }
    fmt::print("{} on {}\n", workbench.clock().name(), workbench.renderer());
}

nlohmann::ordered_json toJson(const Spread& spread) {
    return {{"median", spread.median}, {"low", spread.low}, {"high", spread.high}};
}

void printJson(const std::vector<ContestResult>& results, const BenchArguments& arguments, PictureSize size,
               const Workbench& workbench) {
    nlohmann::ordered_json json = {{"scene", arguments.scene.scene},
                                   {"size", {size.width_px, size.height_px}},
                                   {"renderer", workbench.renderer()},
                                   {"clock", workbench.clock().name()},
                                   {"motion", arguments.still ? "still" : "moving"},
                                   {"results", nlohmann::json::array()}};
    for (const ContestResult& result : results) {
        json["results"].push_back({{"technique", result.contender.label},
                                   {"rounds", result.rounds},
                                   {"ms", toJson(result.cost_ms)},
                                   {"ratio_to_hard", toJson(result.ratio)},
                                   {"memory_bytes", result.memory_bytes},
                                   {"passes_ms", result.passes_ms}});
    }
    std::cout << json.dump(2) << "\n";
}

void bench(const BenchArguments& arguments) {
    OpenedScene opened(arguments.scene);
    const std::vector<Contender> contenders =
        contendersOf(techniqueNames(arguments.techniques), parseSettings(arguments.settings));
    for (const Contender& contender : contenders) {
        for (const auto& [name, value] : contender.settings)
            setParameter(*opened.workbench.makeTechnique(contender.technique), name, value);
    }
    Progress progress("bench");
    const std::vector<ContestResult> results =
        runContest(opened.workbench, opened.moment, opened.camera, opened.size, contenders,
                   {.rounds = arguments.rounds, .moving = !arguments.still, .progress = [&](double fraction) {
                        progress.update(fraction);
                    }});
    if (arguments.json) {
        printJson(results, arguments, opened.size, opened.workbench);
    } else {
        printTable(results, opened.workbench);
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
    command->add_flag("--still", arguments->still,
                      "nothing moves from frame to frame: what techniques keep counts for them");
    command->add_flag("--json", arguments->json, "print the result as JSON instead of a table");
    command->callback([arguments] { bench(*arguments); });
}

}  // namespace penumbra::studio
