// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <iostream>

#include "apps/penumbra/arguments.h"
#include "apps/penumbra/commands.h"
#include "studio/bench/bench_report.h"
#include "studio/errors.h"
#include "studio/json_text.h"
#include "studio/scene/lights/nearest_name.h"
#include "studio/workbench/progress.h"

namespace penumbra::studio {
namespace {

struct BenchArguments {
    SceneArguments scene;
    std::string techniques = "all";
    std::vector<std::string> settings;
    std::string axes;
    std::string output;
    int rounds = 15;
    int samples = 0;
    bool still = false;
    bool full = false;
    bool json = false;
};

/// "map,lights" or "all". Throws UsageError.
std::vector<AxisInfo> parseAxes(const std::string& list) {
    const std::span<const AxisInfo> known = benchAxes();
    if (list == "all") return {known.begin(), known.end()};
    std::vector<AxisInfo> axes;
    for (const std::string& name : CLI::detail::split(list, ',')) {
        if (name.empty()) continue;
        const auto found = std::ranges::find(known, name, &AxisInfo::name);
        if (found == known.end()) {
            std::vector<std::string_view> names;
            for (const AxisInfo& axis : known) names.push_back(axis.name);
            throw UsageError(fmt::format("there is no axis '{}'; there are: {}{}", name,
                                         fmt::join(names, ", "), didYouMean(name, names)));
        }
        axes.push_back(*found);
    }
    return axes;
}

void bench(const BenchArguments& arguments) {
    const std::vector<AxisInfo> axes = parseAxes(arguments.axes);
    if (!arguments.output.empty()) requireWritableFolder(arguments.output, true);
    OpenedScene opened(arguments.scene);
    const std::vector<Contender> contenders =
        contendersOf(parseContenders(arguments.techniques, arguments.settings));
    for (const Contender& contender : contenders) {
        // A wrong parameter ends here, not as a technique that is missing.
        makeTechnique(opened.workbench, contender);
    }

    BenchReport report{.machine = thisMachine(opened.workbench),
                       .scene = arguments.scene.scene,
                       .size = opened.size,
                       .moving = !arguments.still};
    Progress progress("bench");
    report.results =
        runContest(opened.workbench, opened.moment, opened.camera, opened.size, contenders,
                   {.rounds = arguments.rounds, .moving = report.moving, .progress = [&](double share) {
                        progress.update(share, "scene");
                    }});
    if (arguments.samples > 0 && !canJudge()) {
        spdlog::warn(
            "--samples: error against cost is left out; a build for the bench alone has no reference");
    } else if (arguments.samples > 0) {
        report.quality =
            measureQuality(opened.workbench, opened.scene, opened.moment, opened.camera, opened.size,
                           qualityLadder(contenders), arguments.samples, arguments.rounds,
                           [&](double share, const std::string& stage) { progress.update(share, stage); });
    }
    for (const AxisInfo& axis : axes) {
        report.axes.push_back(runAxis(opened.workbench, axis, contenders,
                                      {.full = arguments.full, .progress = [&](double share) {
                                           progress.update(share, std::string(axis.name));
                                       }}));
    }

    if (!arguments.output.empty()) writeBench(arguments.output, report);
    if (arguments.json) {
        std::cout << jsonText(toJson(report));
    } else {
        std::cout << toTable(report);
    }
}

}  // namespace

void addBench(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("bench", "what techniques cost, as ratios to hard in the same run");
    auto arguments = std::make_shared<BenchArguments>();
    arguments->scene.addTo(*command);
    command
        ->add_option("-t,--technique", arguments->techniques,
                     "NAME,NAME or all; NAME:KEY=VALUE sets a parameter")
        ->capture_default_str();
    command
        ->add_option("--set", arguments->settings,
                     "KEY=VALUE: a parameter of the techniques other than hard, NAME.KEY=VALUE of one; may "
                     "be repeated")
        ->take_all();
    command->add_option("--rounds", arguments->rounds, "measured rounds on SCENE")
        ->capture_default_str()
        ->check(CLI::Range(1, 10000));
    command->add_flag("--still", arguments->still,
                      "nothing moves from frame to frame: what techniques keep counts for them");
    command
        ->add_option(
            "--samples", arguments->samples,
            "also judge every technique at several qualities against so many rays a pixel: error against "
            "cost")
        ->check(CLI::Range(2, 65536));
    command->add_option(
        "--axes", arguments->axes,
        "also measure generated scenes along: map, frame, triangles, lights, light-size; or all");
    command->add_flag("--full", arguments->full, "more points and rounds on each axis");
    command->add_option("-o,--output", arguments->output,
                        "a folder for bench.json, bench.csv, tables.md, plots (SVG) and report.html");
    command->add_flag("--json", arguments->json, "print the result as JSON instead of a table");
    command->callback([arguments] { bench(*arguments); });
}

}  // namespace penumbra::studio
