// SPDX-License-Identifier: Apache-2.0
#include "studio/bench/bench_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "studio/bench/bench_plots.h"
#include "studio/image/atomic_file.h"
#include "studio/json_text.h"
#include "studio/report/html.h"

namespace penumbra::studio {
namespace {

std::string processorName() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);) {
        if (line.starts_with("model name")) return line.substr(std::min(line.find(": ") + 2, line.size()));
    }
    return "unknown processor";
}

nlohmann::ordered_json toJson(const Spread& spread) {
    return {{"median", spread.median}, {"low", spread.low}, {"high", spread.high}};
}

nlohmann::ordered_json settingsOf(const Contender& contender) {
    nlohmann::ordered_json json = nlohmann::json::object();
    for (const auto& [key, value] : contender.settings) json[key] = value;
    return json;
}

nlohmann::ordered_json toJson(const std::vector<ContestResult>& results) {
    nlohmann::ordered_json json = nlohmann::json::array();
    for (const ContestResult& result : results) {
        if (!result.missing.empty()) {
            json.push_back({{"technique", result.contender.label}, {"missing", result.missing}});
            continue;
        }
        json.push_back({{"technique", result.contender.label},
                        {"settings", settingsOf(result.contender)},
                        {"rounds", result.rounds},
                        {"ms", toJson(result.cost_ms)},
                        {"ratio_to_hard", toJson(result.ratio)},
                        {"memory_bytes", result.memory_bytes},
                        {"passes_ms", result.passes_ms}});
    }
    return json;
}

void appendCsv(std::string& csv, std::string_view section, const std::string& value,
               const std::vector<ContestResult>& results) {
    for (const ContestResult& result : results) {
        csv += fmt::format("{},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{},{}\n", section, value,
                           result.contender.label, result.cost_ms.median, result.cost_ms.low,
                           result.cost_ms.high, result.ratio.median, result.ratio.low, result.ratio.high,
                           result.rounds, result.memory_bytes);
    }
}

/// Header and rows of one axis: a technique a row, a value a column.
struct AxisTable {
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows;
};

AxisTable tableOf(const AxisResult& axis) {
    AxisTable table{.header = {"technique"}, .rows = {}};
    for (const AxisPoint& point : axis.points) table.header.push_back(fmt::format("{}", point.value));
    for (const ContestResult& first : axis.points.front().results) {
        std::vector<std::string>& row = table.rows.emplace_back();
        row.push_back(first.contender.label);
        for (const AxisPoint& point : axis.points) {
            const auto found = std::ranges::find_if(point.results, [&](const ContestResult& result) {
                return result.contender.label == first.contender.label;
            });
            row.push_back(
                found == point.results.end()
                    ? "-"
                    : fmt::format("{:.1f} ms, {:.1f} x", found->cost_ms.median, found->ratio.median));
        }
    }
    return table;
}

std::string markdownRow(const std::vector<std::string>& cells) {
    return fmt::format("| {} |\n", fmt::join(cells, " | "));
}

const std::vector<std::string> sceneHeader = {"technique", "ms", "quartiles", "x hard", "MB"};

std::vector<std::string> sceneRow(const ContestResult& result) {
    return {result.contender.label, fmt::format("{:.2f}", result.cost_ms.median),
            fmt::format("{:.2f} to {:.2f}", result.cost_ms.low, result.cost_ms.high),
            fmt::format("{:.2f}", result.ratio.median),
            fmt::format("{:.1f}", 1e-6 * double(result.memory_bytes))};
}

std::string leftOutSentence(const AxisResult& axis) {
    std::vector<std::string> parts;
    for (const auto& [label, value] : axis.leftOut) parts.push_back(fmt::format("{} after {}", label, value));
    return parts.empty() ? "" : fmt::format("Left out beyond the limit of time: {}.", fmt::join(parts, ", "));
}

std::vector<QualityPoint> frontOf(const BenchReport& report) {
    std::vector<QualityPoint> front;
    std::ranges::copy_if(report.quality, std::back_inserter(front), &QualityPoint::onFront);
    std::ranges::sort(front, {}, &QualityPoint::ratioToHard);
    return front;
}

std::string machineSentence(const Machine& machine) {
    return fmt::format("{}; {} ({}); {}; commit {}", machine.processor, machine.renderer, machine.driver,
                       machine.clock, machine.commit);
}

}  // namespace

Machine thisMachine(const Workbench& workbench) {
    return {.processor = fmt::format("{}, {} cores", processorName(), std::thread::hardware_concurrency()),
            .renderer = workbench.renderer(),
            .driver = workbench.openGLVersion(),
            .clock = std::string(workbench.clock().name()),
            .commit = PENUMBRA_COMMIT};
}

nlohmann::ordered_json toJson(const BenchReport& report) {
    nlohmann::ordered_json json = {{"machine",
                                    {{"processor", report.machine.processor},
                                     {"driver", report.machine.driver},
                                     {"commit", report.machine.commit}}},
                                   {"renderer", report.machine.renderer},
                                   {"clock", report.machine.clock},
                                   {"scene", report.scene},
                                   {"size", {report.size.width_px, report.size.height_px}},
                                   {"motion", report.moving ? "moving" : "still"},
                                   {"results", toJson(report.results)}};
    for (const QualityPoint& point : report.quality) {
        json["quality"].push_back({{"technique", point.contender.label},
                                   {"settings", settingsOf(point.contender)},
                                   {"ratio_to_hard", point.ratioToHard},
                                   {"penumbra_rmse", point.penumbra_rmse},
                                   {"leak", point.leak},
                                   {"false_shadow", point.false_shadow},
                                   {"on_front", point.onFront}});
    }
    for (const AxisResult& axis : report.axes) {
        nlohmann::ordered_json entry = {{"axis", axis.axis.name}, {"points", nlohmann::json::array()}};
        for (const AxisPoint& point : axis.points)
            entry["points"].push_back({{"value", point.value}, {"results", toJson(point.results)}});
        json["axes"].push_back(std::move(entry));
    }
    return json;
}

std::string toTable(const BenchReport& report) {
    std::string table = fmt::format("{:<14} {:>10} {:>22} {:>8} {:>9}   passes (ms)\n", sceneHeader[0],
                                    sceneHeader[1], sceneHeader[2], sceneHeader[3], sceneHeader[4]);
    for (const ContestResult& result : report.results) {
        const std::vector<std::string> row = sceneRow(result);
        table += fmt::format("{:<14} {:>10} {:>22} {:>8} {:>9}  ", row[0], row[1], row[2], row[3], row[4]);
        for (const auto& [name, ms] : result.passes_ms) table += fmt::format(" {} {:.2f} ", name, ms);
        table += "\n";
    }
    if (!report.quality.empty()) table += "\nNobody is nearer to the truth and cheaper than these:\n";
    for (const QualityPoint& point : frontOf(report)) {
        table += fmt::format("{:<18} {:>8.2f} x hard, penumbra RMSE {:.4f}\n", point.contender.label,
                             point.ratioToHard, point.penumbra_rmse);
    }
    return table + fmt::format("{} on {}\n", report.machine.clock, report.machine.renderer);
}

std::string toCsv(const BenchReport& report) {
    std::string csv =
        "section,value,technique,ms_median,ms_low,ms_high,ratio_median,ratio_low,ratio_high,rounds,memory_"
        "bytes\n";
    appendCsv(csv, "scene", report.scene, report.results);
    for (const AxisResult& axis : report.axes) {
        for (const AxisPoint& point : axis.points)
            appendCsv(csv, axis.axis.name, std::to_string(point.value), point.results);
    }
    return csv;
}

std::string toMarkdown(const BenchReport& report) {
    std::string markdown =
        fmt::format("{}.\n\n## `{}`, {} x {}, {}\n\n", machineSentence(report.machine), report.scene,
                    report.size.width_px, report.size.height_px, report.moving ? "moving" : "still");
    markdown += markdownRow(sceneHeader) + "| --- | ---: | ---: | ---: | ---: |\n";
    for (const ContestResult& result : report.results) markdown += markdownRow(sceneRow(result));
    if (!report.quality.empty()) {
        markdown +=
            "\n## Error against cost\n\n| technique and its knob | x hard | penumbra RMSE | on the front |\n"
            "| --- | ---: | ---: | :---: |\n";
        for (const QualityPoint& point : report.quality) {
            markdown += fmt::format("| {} | {:.2f} | {:.4f} | {} |\n", point.contender.label,
                                    point.ratioToHard, point.penumbra_rmse, point.onFront ? "yes" : "");
        }
    }
    for (const AxisResult& axis : report.axes) {
        const AxisTable table = tableOf(axis);
        markdown += fmt::format("\n## By {}\n\n", axis.axis.title) + markdownRow(table.header) + "| --- |";
        for (std::size_t i = 1; i < table.header.size(); ++i) markdown += " ---: |";
        markdown += "\n";
        for (const std::vector<std::string>& row : table.rows) markdown += markdownRow(row);
        const std::string sentence = leftOutSentence(axis);
        if (!sentence.empty()) markdown += "\n" + sentence + "\n";
    }
    return markdown;
}

void writeBench(const std::filesystem::path& folder, const BenchReport& report) {
    std::string body =
        fmt::format("<p>{}</p>\n<pre>{}</pre>\n", html::escape(machineSentence(report.machine)),
                    html::escape(toTable(report)));
    if (!report.quality.empty()) {
        const std::string svg = toSvg(plotOfQuality(report));
        writeFileAtomically(folder / "error-against-cost.svg", svg);
        body += "<h2>Error against cost</h2>\n" + svg;
    }
    for (const AxisResult& axis : report.axes) {
        const std::string svg = toSvg(plotOf(axis));
        writeFileAtomically(folder / fmt::format("{}.svg", axis.axis.name), svg);
        const AxisTable table = tableOf(axis);
        body += fmt::format("<h2>By {}</h2>\n{}{}<p>{}</p>\n", html::escape(axis.axis.title), svg,
                            html::table(table.header, table.rows), html::escape(leftOutSentence(axis)));
    }
    writeFileAtomically(folder / "bench.json", jsonText(toJson(report)));
    writeFileAtomically(folder / "bench.csv", toCsv(report));
    writeFileAtomically(folder / "tables.md", toMarkdown(report));
    writeFileAtomically(folder / "report.html", html::page("What shadows cost", body));
}

}  // namespace penumbra::studio
