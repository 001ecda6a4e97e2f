// SPDX-License-Identifier: Apache-2.0
#include "studio/bench/quality.h"

#include <algorithm>

namespace penumbra::studio {
namespace {

/// A technique's knobs, all turned to the same, and what to.
struct Ladder {
    std::string technique;
    std::vector<std::string> knobs;
    std::vector<std::string> steps;
};

const std::vector<Ladder>& ladders() {
    static const std::vector<Ladder> all = {
        {"hard", {"map_size"}, {"512", "2048"}},
        {"pcf", {"map_size"}, {"512", "2048"}},
        {"pcss", {"search_samples", "filter_samples"}, {"16", "64", "256"}},
        {"shadow-width", {"map_size"}, {"512", "1024", "2048"}},
        {"smoothies", {"map_size"}, {"512", "1024", "2048"}},
        {"uniform", {"samples"}, {"3", "5", "9", "17"}},
        {"adaptive", {"max_error"}, {"0.1", "0.03", "0.01"}},
        {"soft-volumes", {"samples"}, {"16", "64", "256"}},
        {"exact", {"samples"}, {"16", "64", "256"}}};
    return all;
}

/// What is right of and above another is not on the front.
void markFront(std::vector<QualityPoint>& points) {
    for (QualityPoint& point : points) {
        point.onFront = std::ranges::none_of(points, [&](const QualityPoint& other) {
            return other.ratioToHard <= point.ratioToHard && other.penumbra_rmse <= point.penumbra_rmse &&
                   (other.ratioToHard < point.ratioToHard || other.penumbra_rmse < point.penumbra_rmse);
        });
    }
}

}  // namespace

std::vector<Contender> qualityLadder(std::span<const Contender> asked) {
    std::vector<Contender> contenders = contendersOf({});
    for (const Ladder& ladder : ladders()) {
        if (std::ranges::find(asked, ladder.technique, &Contender::technique) == asked.end()) continue;
        for (const std::string& step : ladder.steps) {
            Contender& contender = contenders.emplace_back();
            contender.label = ladder.technique + " " + step;
            contender.technique = ladder.technique;
            for (const std::string& knob : ladder.knobs) contender.settings.emplace_back(knob, step);
        }
    }
    return contenders;
}

std::vector<QualityPoint> measureQuality(Workbench& workbench, const Scene& scene, const SceneMoment& moment,
                                         const Camera& camera, PictureSize size,
                                         std::span<const Contender> contenders, int samples, int rounds,
                                         const std::function<void(double, const std::string&)>& progress) {
    const std::vector<ContestResult> costs =
        runContest(workbench, moment, camera, size, contenders,
                   {.rounds = rounds, .patience_ms = 20e3, .progress = [&](double share) {
                        progress(share, "cost against error");
                    }});
    std::vector<Contender> present;
    std::vector<QualityPoint> points;
    for (const ContestResult& cost : costs) {
        if (!cost.missing.empty()) continue;
        present.push_back(cost.contender);
        points.push_back({.contender = cost.contender, .ratioToHard = cost.ratio.median});
    }
    const Comparison comparison = judge(workbench, scene, moment, camera, size, present,
                                        {.samples = samples, .timedRuns = 0, .progress = progress});
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::vector<LightComparison>& lights = comparison.techniques[i].lights;
        for (const LightComparison& light : lights) {
            points[i].penumbra_rmse += light.metrics.penumbra_rmse / double(lights.size());
            points[i].leak += light.metrics.leak / double(lights.size());
            points[i].false_shadow += light.metrics.false_shadow / double(lights.size());
        }
    }
    markFront(points);
    return points;
}

}  // namespace penumbra::studio
