// SPDX-License-Identifier: Apache-2.0
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <ctime>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/penumbra/arguments.h"
#include "apps/penumbra/asked_for.h"
#include "apps/penumbra/commands.h"
#include "penumbra/version.h"
#include "studio/bench/bench_report.h"
#include "studio/bench/judge.h"
#include "studio/errors.h"
#include "studio/image/atomic_file.h"
#include "studio/json_text.h"
#include "studio/report/ranking.h"
#include "studio/scene/builtin/builtin.h"
#include "studio/scene/lights/nearest_name.h"
#include "studio/workbench/progress.h"

namespace penumbra::studio {
namespace {

struct CompareArguments {
    std::vector<std::string> scenes;
    SceneArguments view;
    std::string techniques = "all";
    std::string output;
    std::vector<std::string> settings;
    AskedFor askedFor;
    std::vector<std::string> thresholds;
    int samples = 256;
    std::string flicker;
    bool json = false;
};

/// "METRIC=VALUE"
struct Threshold {
    std::string metric;
    double value = 0;
};

/// Names as in toJson.
using MetricValue = double (*)(const TechniqueComparison&, const LightComparison&);
constexpr std::array<std::pair<std::string_view, MetricValue>, 9> metricValues = {
    {{"rmse", [](const auto&, const auto& light) { return light.metrics.rmse; }},
     {"mae", [](const auto&, const auto& light) { return light.metrics.mae; }},
     {"penumbra_rmse", [](const auto&, const auto& light) { return light.metrics.penumbra_rmse; }},
     {"p99", [](const auto&, const auto& light) { return light.metrics.p99; }},
     {"max", [](const auto&, const auto& light) { return light.metrics.max; }},
     {"leak", [](const auto&, const auto& light) { return light.metrics.leak; }},
     {"false_shadow", [](const auto&, const auto& light) { return light.metrics.false_shadow; }},
     {"flip", [](const auto& technique, const auto&) { return technique.flip; }},
     {"flicker", [](const auto&, const auto& light) { return light.flicker ? light.flicker->rms : 0; }}}};

std::vector<Threshold> parseThresholds(const std::vector<std::string>& texts) {
    std::vector<Threshold> thresholds;
    for (const std::string& text : texts) {
        const std::size_t equals = std::min(text.find('='), text.size());
        Threshold threshold{.metric = text.substr(0, equals)};
        const bool known =
            std::ranges::any_of(metricValues, [&](const auto& m) { return m.first == threshold.metric; });
        const char* const end = text.data() + text.size();
        const char* const begin = std::min(text.data() + equals + 1, end);
        const auto parsed = std::from_chars(begin, end, threshold.value);
        if (!known || parsed.ec != std::errc() || parsed.ptr != end || std::isnan(threshold.value)) {
            throw UsageError(
                fmt::format("--fail-above '{}' is not METRIC=VALUE; metrics are rmse, mae, penumbra_rmse, "
                            "p99, max, leak, false_shadow, flip, flicker",
                            text));
        }
        thresholds.push_back(threshold);
    }
    return thresholds;
}

/// Throws ThresholdError naming everything that is exceeded.
void requireBelow(std::span<const Comparison> comparisons, const std::vector<Threshold>& thresholds) {
    std::string exceeded;
    for (const Comparison& comparison : comparisons) {
        for (const TechniqueComparison& technique : comparison.techniques) {
            for (const LightComparison& light : technique.lights) {
                for (const Threshold& threshold : thresholds) {
                    const auto metric = std::ranges::find(metricValues, threshold.metric,
                                                          &decltype(metricValues)::value_type::first);
                    const double value = metric->second(technique, light);
                    if (value <= threshold.value) continue;
                    exceeded +=
                        fmt::format("{}{}: {} on light '{}': {} is {:.6g}, above {:g}",
                                    exceeded.empty() ? "" : "\n", comparison.scene, technique.technique,
                                    light.light, threshold.metric, value, threshold.value);
                }
            }
        }
    }
    if (!exceeded.empty()) throw ThresholdError(exceeded);
}

/// What moves; throws UsageError.
std::optional<FlickerMotion> parseFlicker(const std::string& name) {
    if (name.empty()) return std::nullopt;
    if (name == "animation") return FlickerMotion::animation;
    if (name == "camera") return FlickerMotion::camera;
    if (name == "light") return FlickerMotion::light;
    constexpr std::array<std::string_view, 3> known = {"animation", "camera", "light"};
    throw UsageError(
        fmt::format("--flicker '{}' is not animation, camera or light{}", name, didYouMean(name, known)));
}

/// "all" as the names of the built-in scenes.
std::vector<std::string> sceneNames(const std::vector<std::string>& scenes) {
    if (scenes != std::vector<std::string>{"all"}) return scenes;
    std::vector<std::string> names;
    for (const BuiltinInfo& info : builtinScenes()) names.emplace_back(info.name);
    return names;
}

Comparison compareScene(const SceneArguments& scene, const std::vector<Contender>& contenders, int samples,
                        std::optional<FlickerMotion> flicker, Machine& machine) {
    OpenedScene opened(scene);
    machine = thisMachine(opened.workbench);
    if (flicker == FlickerMotion::animation && opened.scene.animations.empty()) {
        throw UsageError(fmt::format("{} has no animation: ask for --flicker camera or light", scene.scene));
    }
    Progress progress(scene.scene);
    Comparison comparison = judge(
        opened.workbench, opened.scene, opened.moment, opened.camera, opened.size, contenders,
        {.samples = samples, .flicker = flicker, .progress = [&](double fraction, const std::string& what) {
             progress.update(fraction, what);
         }});
    comparison.scene = scene.scene;
    return comparison;
}

/// Throws now what would end the work when it is this scene's turn.
void requireScenes(const std::vector<std::string>& scenes, const SceneArguments& view) {
    for (const std::string& name : scenes) {
        const Scene scene = openScene(name, view.openOptions());
        view.cameraIn(scene, scene.at(view.time_s));
    }
}

/// A folder for each of several scenes: its name, or its file's without the extension.
std::filesystem::path folderOf(const std::filesystem::path& output, const std::string& scene, bool alone) {
    return alone ? output : output / std::filesystem::path(scene).stem();
}

/// What a figure in a paper must be able to say of itself.
nlohmann::ordered_json provenanceOf(const Machine& machine, const std::string& commandLine) {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    return {{"version", version()},
            {"commit", machine.commit},
            {"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", utc)},
            {"command", commandLine},
            {"processor", machine.processor},
            {"driver", machine.driver}};
}

void compare(const CompareArguments& arguments, const std::string& commandLine) {
    const std::vector<std::string> scenes = sceneNames(arguments.scenes);
    const std::vector<Threshold> thresholds = parseThresholds(arguments.thresholds);
    const std::optional<FlickerMotion> flicker = parseFlicker(arguments.flicker);
    if (!flicker && std::ranges::find(thresholds, "flicker", &Threshold::metric) != thresholds.end()) {
        throw UsageError("--fail-above flicker needs --flicker, which says what moves");
    }
    std::vector<Contender> contenders = parseContenders(arguments.techniques, arguments.settings);
    for (Contender& contender : contenders) {
        const auto settings = arguments.askedFor.settingsOf(contender.technique);
        contender.settings.insert(contender.settings.begin(), settings.begin(), settings.end());
    }
    const bool alone = scenes.size() == 1;
    if (!alone) requireScenes(scenes, arguments.view);
    if (!arguments.output.empty()) {
        std::set<std::filesystem::path> folders;
        for (const std::string& scene : scenes) {
            const std::filesystem::path folder = folderOf(arguments.output, scene, alone);
            if (!folders.insert(folder).second) {
                throw UsageError(
                    fmt::format("two scenes would write to {}: compare them one by one", folder.string()));
            }
            requireWritableFolder(folder, true);
        }
    }

    std::vector<Comparison> comparisons;
    Machine machine;
    for (const std::string& name : scenes) {
        SceneArguments scene = arguments.view;
        scene.scene = name;
        Comparison& comparison =
            comparisons.emplace_back(compareScene(scene, contenders, arguments.samples, flicker, machine));
        comparison.command = commandLine;
        if (!arguments.output.empty()) {
            writeComparison(folderOf(arguments.output, name, alone), comparison,
                            pictureMetadata(commandLine));
        }
    }
    if (!alone && !arguments.output.empty()) {
        const std::filesystem::path folder = arguments.output;
        writeFileAtomically(folder / "report.html", toHtml(comparisons, commandLine));
        writeFileAtomically(folder / "tables.md", toMarkdown(comparisons));
    }
    const nlohmann::ordered_json results = alone ? toJson(comparisons.front()) : toJson(comparisons);
    if (!arguments.output.empty()) {
        const std::filesystem::path folder = arguments.output;
        nlohmann::ordered_json file = {{"made", provenanceOf(machine, commandLine)}};
        file.update(results);
        writeFileAtomically(folder / "results.json", jsonText(file));
        writeFileAtomically(folder / "results.csv", toCsv(comparisons));
        spdlog::info("pictures, EXR, report.html, results.json and results.csv are in {}", folder.string());
    }
    if (arguments.json) {
        std::cout << jsonText(results);
    } else {
        for (const Comparison& comparison : comparisons) {
            if (!alone) std::cout << comparison.scene << "\n";
            std::cout << toTable(comparison) << (alone ? "" : "\n");
        }
        if (!alone) std::cout << rankingTable(comparisons);
    }
    requireBelow(comparisons, thresholds);
}

}  // namespace

void addCompare(CLI::App& app, const std::string& commandLine) {
    CLI::App* command = app.add_subcommand("compare", "judge techniques against the ray-traced reference");
    auto arguments = std::make_shared<CompareArguments>();
    command
        ->add_option("SCENE", arguments->scenes,
                     "glTF 2.0 files (.gltf, .glb) or names of built-in scenes; 'all': all built-in ones")
        ->required();
    arguments->view.addFlagsTo(*command);
    command
        ->add_option("-t,--technique", arguments->techniques,
                     "NAME,NAME or all; NAME:KEY=VALUE sets a parameter")
        ->capture_default_str();
    command->add_option("-o,--output", arguments->output,
                        "a folder for pictures, EXR, report.html, results.json and results.csv");
    command->add_option("--samples", arguments->samples, "rays for each pixel of the reference")
        ->capture_default_str();
    command
        ->add_option("--set", arguments->settings,
                     "KEY=VALUE: a parameter of the techniques, NAME.KEY=VALUE of one; may be repeated")
        ->take_all();
    arguments->askedFor.addTo(*command);
    command->add_option(
        "--flicker", arguments->flicker,
        "also measure flicker, over 8 frames in which this moves: animation, camera or light");
    command
        ->add_option("--fail-above", arguments->thresholds,
                     "METRIC=VALUE: exit with 1 if any technique's METRIC, named as in --json, is larger; "
                     "may be repeated")
        ->take_all();
    command->add_flag("--json", arguments->json, "print the result as JSON instead of a table");
    command->callback([arguments, commandLine] { compare(*arguments, commandLine); });
}

}  // namespace penumbra::studio
