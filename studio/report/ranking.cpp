// SPDX-License-Identifier: Apache-2.0
#include "studio/report/ranking.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "studio/metrics/difference_image.h"
#include "studio/report/html.h"
#include "studio/report/report_files.h"

namespace penumbra::studio {
namespace {

using LightValue = std::function<double(const LightComparison&)>;

/// Over all lights of a technique in one scene.
double meanOf(const TechniqueComparison& technique, const LightValue& value) {
    double sum = 0;
    for (const LightComparison& light : technique.lights) sum += value(light);
    return technique.lights.empty() ? 0 : sum / double(technique.lights.size());
}

double frame_ms(const TechniqueComparison& technique) {
    double sum_ms = 0;
    for (const LightComparison& light : technique.lights) sum_ms += medianOf(light.milliseconds);
    return sum_ms;
}

/// Cost of technique `i` over that of `hard`.
std::optional<double> ratioToHard(const Comparison& comparison, std::size_t i) {
    const auto hard = std::ranges::find(comparison.techniques, "hard", &TechniqueComparison::technique);
    if (hard == comparison.techniques.end() || !(frame_ms(*hard) > 0)) return std::nullopt;
    return frame_ms(comparison.techniques[i]) / frame_ms(*hard);
}

/// What the tables show of one technique in one scene.
struct Measure {
    const char* title;
    const char* format;
    std::function<std::optional<double>(const Comparison&, std::size_t)> value;
};

Measure perLight(const char* title, const char* format, LightValue value) {
    return {title, format, [value](const Comparison& comparison, std::size_t i) -> std::optional<double> {
                return meanOf(comparison.techniques[i], value);
            }};
}

std::vector<Measure> measures(std::span<const Comparison> comparisons) {
    std::vector<Measure> all = {
        perLight("Penumbra RMSE", "{:.3f}", [](const auto& l) { return l.metrics.penumbra_rmse; }),
        perLight("Share of umbra pixels that leak, in percent", "{:.2f}",
                 [](const auto& l) { return 100 * l.metrics.leak; }),
        perLight("Share of lit pixels with a false shadow, in percent", "{:.2f}",
                 [](const auto& l) { return 100 * l.metrics.false_shadow; })};
    const bool flicker = !comparisons.empty() && !comparisons[0].techniques.empty() &&
                         !comparisons[0].techniques[0].lights.empty() &&
                         comparisons[0].techniques[0].lights[0].flicker.has_value();
    if (flicker) {
        all.push_back(perLight("Flicker (RMS of the change beyond the truth's own)", "{:.4f}",
                               [](const auto& l) { return l.flicker ? l.flicker->rms : 0; }));
    }
    all.push_back({"Cost of a view that stands still, as a ratio to `hard`", "{:.1f}", ratioToHard});
    return all;
}

std::string cell(const Measure& measure, const Comparison& comparison, std::size_t i) {
    const std::optional<double> value = measure.value(comparison, i);
    return value ? fmt::format(fmt::runtime(measure.format), *value) : "-";
}

std::vector<std::string> cellsOf(const Rank& rank) {
    return {rank.technique,
            fmt::format("{:.4f}", rank.penumbra_rmse),
            fmt::format("{:.2f} %", 100 * rank.leak),
            fmt::format("{:.2f} %", 100 * rank.false_shadow),
            fmt::format("{:.4f}", rank.flip),
            rank.flicker ? fmt::format("{:.4f}", *rank.flicker) : "-",
            rank.ratioToHard ? fmt::format("{:.2f}", *rank.ratioToHard) : "-"};
}

const std::vector<std::string> rankHeader = {"technique", "penumbra RMSE", "leak",  "false shadow",
                                             "FLIP",      "flicker",       "x hard"};

std::string rankingHtml(const std::vector<Rank>& ranks) {
    std::vector<std::vector<std::string>> rows;
    for (const Rank& one : ranks) rows.push_back(cellsOf(one));
    return html::table(rankHeader, rows);
}

std::string sceneHtml(const Comparison& comparison) {
    std::string body = fmt::format("<h2>{}</h2>\n<p>{} x {} pixels; {} rays a pixel, noise {:.4f} rms</p>\n",
                                   html::escape(comparison.scene), comparison.width_px, comparison.height_px,
                                   comparison.reference.samples, comparison.reference.noise_rms);
    body += fmt::format("<pre>{}</pre>\n", html::escape(toTable(comparison)));
    body += "<div class=\"row\">" + html::figure(comparison.reference.display, "reference");
    for (const TechniqueComparison& technique : comparison.techniques) {
        body += html::figure(technique.display, technique.technique);
        for (std::size_t i = 0; i < technique.lights.size(); ++i) {
            body += html::figure(
                differenceImage(comparison.reference.visibilities[i], technique.lights[i].visibility),
                technique.technique + " - truth, x5, light " + technique.lights[i].light);
        }
    }
    return body + "</div>\n";
}

}  // namespace

std::vector<Rank> rank(std::span<const Comparison> comparisons) {
    std::vector<Rank> ranks;
    if (comparisons.empty()) return ranks;
    for (std::size_t i = 0; i < comparisons[0].techniques.size(); ++i) {
        Rank& sum = ranks.emplace_back();
        sum.technique = comparisons[0].techniques[i].technique;
        double lights = 0, flicker = 0, logRatio = 0;
        bool hasFlicker = true, hasRatio = true;
        for (const Comparison& comparison : comparisons) {
            const TechniqueComparison& technique = comparison.techniques[i];
            for (const LightComparison& light : technique.lights) {
                sum.penumbra_rmse += light.metrics.penumbra_rmse;
                sum.leak += light.metrics.leak;
                sum.false_shadow += light.metrics.false_shadow;
                sum.flip += technique.flip;
                hasFlicker &= light.flicker.has_value();
                flicker += light.flicker ? light.flicker->rms : 0;
                ++lights;
            }
            const std::optional<double> ratio = ratioToHard(comparison, i);
            hasRatio &= ratio && *ratio > 0;
            if (hasRatio) logRatio += std::log(*ratio);
        }
        for (double* value : {&sum.penumbra_rmse, &sum.leak, &sum.false_shadow, &sum.flip})
            *value /= std::max(lights, 1.0);
        if (hasFlicker && lights > 0) sum.flicker = flicker / lights;
        if (hasRatio) sum.ratioToHard = std::exp(logRatio / double(comparisons.size()));
    }
    return ranks;
}

nlohmann::ordered_json toJson(std::span<const Comparison> comparisons) {
    nlohmann::ordered_json json = {{"comparisons", nlohmann::json::array()},
                                   {"ranking", nlohmann::json::array()}};
    for (const Comparison& comparison : comparisons) json["comparisons"].push_back(toJson(comparison));
    std::vector<Rank> ranks = rank(comparisons);
    std::ranges::sort(ranks, {}, &Rank::penumbra_rmse);
    for (const Rank& one : ranks) {
        nlohmann::ordered_json entry = {{"technique", one.technique},
                                        {"penumbra_rmse", one.penumbra_rmse},
                                        {"leak", one.leak},
                                        {"false_shadow", one.false_shadow},
                                        {"flip", one.flip}};
        if (one.flicker) entry["flicker"] = *one.flicker;
        if (one.ratioToHard) entry["ratio_to_hard"] = *one.ratioToHard;
        json["ranking"].push_back(std::move(entry));
    }
    return json;
}

std::string rankingTable(std::span<const Comparison> comparisons) {
    std::vector<Rank> ranks = rank(comparisons);
    std::ranges::sort(ranks, {}, &Rank::penumbra_rmse);
    std::string table;
    const auto line = [&](const std::vector<std::string>& cells) {
        table += fmt::format("{:<14} {:>14} {:>9} {:>13} {:>8} {:>8} {:>8}\n", cells[0], cells[1], cells[2],
                             cells[3], cells[4], cells[5], cells[6]);
    };
    line(rankHeader);
    for (const Rank& one : ranks) line(cellsOf(one));
    return table + fmt::format("means over {} scenes\n", comparisons.size());
}

std::string toHtml(std::span<const Comparison> comparisons, const std::string& command) {
    std::vector<Rank> ranks = rank(comparisons);
    std::string body =
        fmt::format("<p>Times: {} on {}.<br><code>{}</code></p>\n",
                    comparisons.empty() ? "" : html::escape(comparisons[0].clock),
                    comparisons.empty() ? "" : html::escape(comparisons[0].renderer), html::escape(command));
    std::ranges::sort(ranks, {}, &Rank::penumbra_rmse);
    body += "<h2>By error</h2>\n" + rankingHtml(ranks);
    std::ranges::sort(ranks, {}, [](const Rank& one) { return one.ratioToHard.value_or(0); });
    body += "<h2>By time</h2>\n" + rankingHtml(ranks);
    for (const Comparison& comparison : comparisons) body += sceneHtml(comparison);
    return html::page("Shadows compared", body);
}

std::string toMarkdown(std::span<const Comparison> comparisons) {
    std::string markdown;
    if (comparisons.empty()) return markdown;
    for (const Measure& measure : measures(comparisons)) {
        markdown += fmt::format("## {}\n\n| scene |", measure.title);
        std::string rule = "| --- |";
        for (const TechniqueComparison& technique : comparisons[0].techniques) {
            markdown += fmt::format(" `{}` |", technique.technique);
            rule += " ---: |";
        }
        markdown += "\n" + rule + "\n";
        for (const Comparison& comparison : comparisons) {
            markdown += fmt::format("| `{}` |", comparison.scene);
            for (std::size_t i = 0; i < comparison.techniques.size(); ++i)
                markdown += " " + cell(measure, comparison, i) + " |";
            markdown += "\n";
        }
        markdown += "\n";
    }
    return markdown;
}

}  // namespace penumbra::studio
