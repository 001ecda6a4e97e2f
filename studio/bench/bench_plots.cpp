// SPDX-License-Identifier: Apache-2.0
#include "studio/bench/bench_plots.h"

#include <algorithm>

namespace penumbra::studio {
namespace {

/// One series for each technique of the catalog, in its order, so that a technique has one colour everywhere.
std::vector<PlotSeries> emptySeries() {
    std::vector<PlotSeries> series;
    for (const TechniqueInfo& info : techniqueCatalog())
        series.push_back({.name = std::string(info.name), .points = {}});
    return series;
}

PlotSeries& seriesOf(std::vector<PlotSeries>& all, const std::string& technique) {
    const auto found = std::ranges::find(all, technique, &PlotSeries::name);
    return found != all.end() ? *found : all.emplace_back(PlotSeries{.name = technique, .points = {}});
}

}  // namespace

Plot plotOf(const AxisResult& axis) {
    Plot plot{.title = "Cost of a frame by " + std::string(axis.axis.title),
              .x = {.title = std::string(axis.axis.title), .logarithmic = true},
              .y = {.title = "ms", .logarithmic = true},
              .series = emptySeries()};
    for (const AxisPoint& point : axis.points) {
        for (const ContestResult& result : point.results) {
            seriesOf(plot.series, result.contender.technique)
                .points.push_back({.x = double(point.value),
                                   .y = result.cost_ms.median,
                                   .low = result.cost_ms.low,
                                   .high = result.cost_ms.high});
        }
    }
    return plot;
}

Plot plotOfQuality(const BenchReport& report) {
    Plot plot{.title = "Error against cost: " + report.scene,
              .x = {.title = "cost, as a ratio to hard", .logarithmic = true},
              .y = {.title = "RMSE in the penumbra", .logarithmic = true},
              .series = emptySeries()};
    for (const QualityPoint& point : report.quality) {
        const PlotPoint at{.x = point.ratioToHard, .y = point.penumbra_rmse};
        const std::size_t space = point.contender.label.find(' ');
        const std::string knob = space == std::string::npos ? "" : point.contender.label.substr(space + 1);
        seriesOf(plot.series, point.contender.technique)
            .points.push_back({.x = at.x, .y = at.y, .label = knob});
        if (point.onFront) plot.front.push_back(at);
    }
    std::ranges::sort(plot.front, {}, &PlotPoint::x);
    return plot;
}

}  // namespace penumbra::studio
