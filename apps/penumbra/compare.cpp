// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "apps/penumbra/arguments.h"
#include "apps/penumbra/commands.h"
#include "studio/errors.h"
#include "studio/metrics/flip.h"
#include "studio/report/comparison.h"
#include "studio/workbench/progress.h"
#include "studio/workbench/reference_technique.h"

namespace penumbra::studio {
namespace {

constexpr int timedRuns = 5;

struct CompareArguments {
    SceneArguments scene;
    std::string techniques = "all";
    std::string output;
    std::vector<std::string> settings;
    std::vector<std::string> thresholds;
    int samples = 256;
    bool json = false;
};

/// "METRIC=VALUE"
struct Threshold {
    std::string metric;
    double value = 0;
};

/// Names as in toJson.
constexpr std::array<std::pair<std::string_view, double VisibilityMetrics::*>, 7> metricMembers = {
    {{"rmse", &VisibilityMetrics::rmse},
     {"mae", &VisibilityMetrics::mae},
     {"penumbra_rmse", &VisibilityMetrics::penumbra_rmse},
     {"p99", &VisibilityMetrics::p99},
     {"max", &VisibilityMetrics::max},
     {"leak", &VisibilityMetrics::leak},
     {"false_shadow", &VisibilityMetrics::false_shadow}}};

std::vector<Threshold> parseThresholds(const std::vector<std::string>& texts) {
    std::vector<Threshold> thresholds;
    for (const std::string& text : texts) {
        const std::size_t equals = std::min(text.find('='), text.size());
        Threshold threshold{.metric = text.substr(0, equals)};
        const bool known =
            threshold.metric == "flip" ||
            std::ranges::any_of(metricMembers, [&](const auto& m) { return m.first == threshold.metric; });
        const char* const end = text.data() + text.size();
        const char* const begin = std::min(text.data() + equals + 1, end);
        const auto parsed = std::from_chars(begin, end, threshold.value);
        if (!known || parsed.ec != std::errc() || parsed.ptr != end || std::isnan(threshold.value)) {
            throw UsageError(
                fmt::format("--fail-above '{}' is not METRIC=VALUE; metrics are rmse, mae, penumbra_rmse, "
                            "p99, max, leak, false_shadow, flip",
                            text));
        }
        thresholds.push_back(threshold);
    }
    return thresholds;
}

/// Throws ThresholdError naming everything that is exceeded.
void requireBelow(const Comparison& comparison, const std::vector<Threshold>& thresholds) {
    std::string exceeded;
    for (const TechniqueComparison& technique : comparison.techniques) {
        for (const LightComparison& light : technique.lights) {
            for (const Threshold& threshold : thresholds) {
                double value = technique.flip;
                for (const auto& [name, member] : metricMembers) {
                    if (name == threshold.metric) value = light.metrics.*member;
                }
                if (value <= threshold.value) continue;
                exceeded +=
                    fmt::format("{}{} on light '{}': {} is {:.6g}, above {:g}", exceeded.empty() ? "" : "\n",
                                technique.technique, light.light, threshold.metric, value, threshold.value);
            }
        }
    }
    if (!exceeded.empty()) throw ThresholdError(exceeded);
}

/// Where the unshadowed light arrives: nothing else is judged.
std::vector<std::uint8_t> reachedPixels(const Image& reach) {
    std::vector<std::uint8_t> mask(reach.pixelCount());
    std::ranges::transform(reach.values, mask.begin(), [](float irradiance) { return irradiance > 0; });
    return mask;
}

double countOf(const Statistics& statistics, std::string_view name) {
    const auto found = std::ranges::find(statistics.counts, name, &Statistic::name);
    return found == statistics.counts.end() ? 0 : found->value;
}

ReferenceSummary summarize(const TechniqueResult& truth, int samples) {
    ReferenceSummary summary{.samples = samples, .display = truth.display};
    double rays = 0, seconds = 0;
    for (const LightResult& light : truth.lights) {
        summary.noise_rms = std::max(summary.noise_rms, countOf(light.statistics, "noise_rms"));
        summary.visibilities.push_back(light.visibility);
        rays += countOf(light.statistics, "rays");
        seconds += countOf(light.statistics, "trace_seconds");
    }
    summary.raysPerSecond = seconds > 0 ? rays / seconds : 0;
    return summary;
}

TechniqueComparison judge(const TechniqueResult& truth, TechniqueResult&& result) {
    TechniqueComparison comparison{.technique = result.technique,
                                   .flip = flip(truth.display, result.display),
                                   .display = std::move(result.display)};
    for (std::size_t i = 0; i < result.lights.size(); ++i) {
        LightResult& light = result.lights[i];
        LightComparison& judged = comparison.lights.emplace_back();
        judged.light = light.light;
        judged.metrics =
            compareVisibility(truth.lights[i].visibility, light.visibility, reachedPixels(light.reach));
        judged.milliseconds = std::move(light.milliseconds);
        for (const Statistic& count : light.statistics.counts) {
            judged.counts.emplace_back(count.name, count.value);
        }
        judged.visibility = std::move(light.visibility);
        if (judged.metrics.notFinite > 0) {
            throw std::runtime_error(
                fmt::format("{}: {} visibility values are not finite, the first at pixel {}, {}",
                            comparison.technique, judged.metrics.notFinite, judged.metrics.firstNotFinite->x,
                            judged.metrics.firstNotFinite->y));
        }
    }
    return comparison;
}

void compare(const CompareArguments& arguments, const std::string& commandLine) {
    const std::vector<std::string> names = techniqueNames(arguments.techniques);
    const std::vector<Threshold> thresholds = parseThresholds(arguments.thresholds);
    if (!arguments.output.empty()) requireWritableFolder(arguments.output, true);
    OpenedScene opened(arguments.scene);
    auto& [size, scene, moment, camera, workbench] = opened;

    ReferenceTechnique reference;
    setParameter(reference, "samples", std::to_string(arguments.samples));
    TechniqueResult truth;
    {
        Progress progress("reference");
        reference.setProgress([&](double fraction) { progress.update(fraction); });
        truth = workbench.run("reference", reference, moment, camera, size);
    }

    Comparison comparison{.scene = arguments.scene.scene,
                          .width_px = size.width_px,
                          .height_px = size.height_px,
                          .renderer = workbench.renderer(),
                          .clock = std::string(workbench.clock().name()),
                          .command = commandLine,
                          .reference = summarize(truth, arguments.samples)};
    Progress progress("techniques");
    for (const std::string& name : names) {
        progress.update(double(comparison.techniques.size()) / double(names.size()));
        const std::unique_ptr<Technique> technique = workbench.makeTechnique(name);
        applySettings(*technique, arguments.settings);
        comparison.techniques.push_back(
            judge(truth, workbench.run(name, *technique, moment, camera, size, timedRuns)));
    }

    if (!arguments.output.empty())
        writeComparison(arguments.output, comparison, pictureMetadata(commandLine));
    if (arguments.json) {
        std::cout << toJson(comparison).dump(2) << "\n";
    } else {
        std::cout << toTable(comparison);
    }
    requireBelow(comparison, thresholds);
}

}  // namespace

void addCompare(CLI::App& app, const std::string& commandLine) {
    CLI::App* command = app.add_subcommand("compare", "judge techniques against the ray-traced reference");
    auto arguments = std::make_shared<CompareArguments>();
    arguments->scene.addTo(*command);
    command->add_option("-t,--technique", arguments->techniques, "NAME,NAME or all")->capture_default_str();
    command->add_option("-o,--output", arguments->output,
                        "a folder for pictures, differences and report.html");
    command->add_option("--samples", arguments->samples, "rays for each pixel of the reference")
        ->capture_default_str();
    command
        ->add_option("--set", arguments->settings,
                     "KEY=VALUE: a parameter of the techniques; may be repeated")
        ->take_all();
    command
        ->add_option("--fail-above", arguments->thresholds,
                     "METRIC=VALUE: exit with 1 if any technique's METRIC, named as in --json, is larger; "
                     "may be repeated")
        ->take_all();
    command->add_flag("--json", arguments->json, "print the result as JSON instead of a table");
    command->callback([arguments, commandLine] { compare(*arguments, commandLine); });
}

}  // namespace penumbra::studio
