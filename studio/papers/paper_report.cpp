// SPDX-License-Identifier: Apache-2.0
#include "studio/papers/paper_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "studio/report/html.h"

namespace penumbra::studio {
namespace {

std::string sentence(const ClaimResult& claim) {
    if (!claim.ours) return fmt::format("Not measured: {}.", claim.text);
    std::string text = fmt::format("{}: {} (ratio {:.2f} here",
                                   claim.holds() ? "Holds" : "Does not hold here", claim.text, *claim.ours);
    if (claim.paper) {
        text += fmt::format(", {:.2f} in the paper", *claim.paper);
        if (!claim.isNearPaper())
            text += fmt::format(", more than {:g} times apart; {}", claim.factor,
                                claim.hasOrder() ? "the order is the paper's" : "the order is another, too");
    }
    if (claim.isBroken) text += "; the picture is visibly broken";
    return text + ").";
}

/// Which row's numbers of maps are nearest to the paper's, all columns together.
std::string nearestRow(const TableResult& result) {
    std::string nearest;
    double least = INFINITY;
    for (const Cell& first : result.table.cells) {
        double distance = 0;
        std::string counts;
        for (std::size_t i = 0; i < result.cells.size(); ++i) {
            const CellResult& cell = result.cells[i];
            if (result.table.cells[i].row != first.row) continue;
            distance += cell.ours > 0 ? std::abs(std::log(cell.ours / cell.paper)) : INFINITY;
            counts += fmt::format("{}{:.0f} (the paper's {:.0f})", counts.empty() ? "" : " and ", cell.ours,
                                  cell.paper);
        }
        if (!(distance < least)) continue;
        least = distance;
        nearest = fmt::format("Nearest to the paper's: {}, {} maps.", first.row, counts);
    }
    return nearest.empty() ? "Not measured." : nearest;
}

/// How our ratios relate to the paper's, over all cells but the baseline.
std::string sentence(const TableResult& result) {
    if (result.table.unit == "maps") return nearestRow(result);
    double logSum = 0, low = INFINITY, high = 0;
    int count = 0, pairs = 0, agreeing = 0;
    for (std::size_t i = 0; i < result.cells.size(); ++i) {
        const CellResult& cell = result.cells[i];
        if (!(cell.ours > 0)) continue;
        if (result.table.cells[i].row != result.table.baselineRow) {
            const double factor = cell.ours / cell.paper;
            logSum += std::log(factor);
            low = std::min(low, factor);
            high = std::max(high, factor);
            ++count;
        }
        for (std::size_t k = 0; k < i; ++k) {
            if (!(result.cells[k].ours > 0) || result.table.cells[k].column != result.table.cells[i].column)
                continue;
            if (result.cells[k].paper == cell.paper) continue;
            ++pairs;
            agreeing += (result.cells[k].ours < cell.ours) == (result.cells[k].paper < cell.paper);
        }
    }
    if (count == 0) return "Not measured.";
    return fmt::format(
        "Our ratios are {:.2f} to {:.2f} times the paper's (geometric mean {:.2f}); of {} pairs in a "
        "column {:.0f} % are in the paper's order.",
        low, high, std::exp(logSum / count), pairs, 100.0 * agreeing / std::max(pairs, 1));
}

std::string paragraph(const char* kind, const std::string& text) {
    return text.empty() ? "" : fmt::format("<p class=\"{}\">{}</p>\n", kind, html::escape(text));
}

std::string standInNote(const std::vector<std::string>& standIns) {
    return standIns.empty() ? "" : fmt::format("Stand-ins: {}.", fmt::join(standIns, ", "));
}

std::string spread(const Spread& cost_ms) {
    return fmt::format("{:.1f} ms ({:.1f} to {:.1f})", cost_ms.median, cost_ms.low, cost_ms.high);
}

std::string optionalNumber(const std::optional<double>& value, const char* format) {
    return value ? fmt::format(fmt::runtime(format), *value) : "";
}

/// The measurements of a figure's panels; ratios of cost are to the first panel that has one.
std::string measurements(const FigureResult& result) {
    std::vector<std::vector<std::string>> rows;
    std::optional<std::size_t> first;
    bool anything = false;
    for (std::size_t i = 0; i < result.panels.size(); ++i) {
        const Panel& panel = result.figure.panels[i];
        const PanelResult& printed = result.panels[i];
        const bool measured = panel.show == Show::picture || panel.show == Show::visibility;
        if (panel.technique == "reference" || !measured || !printed.missing.empty()) continue;
        if (!first && printed.cost_ms) first = i;
        const std::size_t base = panel.base.value_or(first.value_or(i));
        const std::optional<Spread>& baseCost = result.panels[base].cost_ms;
        const std::optional<double>& basePaper = result.figure.panels[base].paper;
        const auto costRatio = printed.cost_ms && baseCost
                                   ? std::optional(printed.cost_ms->median / baseCost->median)
                                   : std::nullopt;
        const auto paperRatio =
            panel.paper && basePaper ? std::optional(*basePaper / *panel.paper) : std::nullopt;
        anything |= printed.cost_ms || printed.penumbraError;
        rows.push_back({panel.caption, optionalNumber(printed.penumbraError, "{:.4f}"),
                        optionalNumber(printed.maps, "{:.0f}"), optionalNumber(panel.paperMaps, "{:.0f}"),
                        printed.cost_ms ? spread(*printed.cost_ms) : "",
                        optionalNumber(costRatio, "{:.2f} x"), optionalNumber(panel.paper, "{:g} fps"),
                        optionalNumber(paperRatio, "{:.2f} x")});
    }
    if (!anything) return "";
    std::vector<std::string> header = {"",     "penumbra RMSE", "maps",        "the paper's maps",
                                       "cost", "cost ratio",    "the paper's", "paper's cost ratio"};
    // Columns in which nothing stands say nothing.
    for (std::size_t column = header.size(); column-- > 1;) {
        if (std::ranges::any_of(rows, [&](const auto& row) { return !row[column].empty(); })) continue;
        header.erase(header.begin() + std::ptrdiff_t(column));
        for (std::vector<std::string>& row : rows) row.erase(row.begin() + std::ptrdiff_t(column));
    }
    return html::table(header, rows);
}

std::string figureHtml(const FigureResult& result) {
    const Figure& figure = result.figure;
    std::string body = fmt::format("<h2>{}: {}</h2>\n", html::escape(figure.id), html::escape(figure.title));
    if (result.plot) body += toSvg(*result.plot);
    body += figure.columns > 0
                ? fmt::format("<div class=\"row\" style=\"grid-template-columns: repeat({}, 1fr)\">",
                              figure.columns)
                : "<div class=\"row\">";
    for (std::size_t i = 0; i < result.panels.size(); ++i) {
        const PanelResult& printed = result.panels[i];
        body += printed.missing.empty()
                    ? html::figure(printed.image, figure.panels[i].caption)
                    : fmt::format("<figure class=\"missing\">{}: {}</figure>\n",
                                  html::escape(figure.panels[i].caption), html::escape(printed.missing));
    }
    body += "</div>\n" + measurements(result);
    for (const ClaimResult& claim : result.claims) body += paragraph("judgement", sentence(claim));
    return body + paragraph("paper", figure.note) + paragraph("paper", standInNote(result.standIns));
}

/// Rows and columns in the order in which the cells name them first.
std::vector<std::string> namesOf(const Table& table, std::string Cell::*name) {
    std::vector<std::string> names;
    for (const Cell& cell : table.cells) {
        if (std::ranges::find(names, cell.*name) == names.end()) names.push_back(cell.*name);
    }
    return names;
}

std::string tableHtml(const TableResult& result) {
    const Table& table = result.table;
    std::vector<std::string> header = namesOf(table, &Cell::column);
    header.insert(header.begin(), "");
    std::vector<std::vector<std::string>> rows;
    for (const std::string& name : namesOf(table, &Cell::row)) {
        std::vector<std::string>& row = rows.emplace_back(header.size());
        row[0] = name;
        for (std::size_t i = 0; i < table.cells.size(); ++i) {
            if (table.cells[i].row != name) continue;
            const auto column =
                std::size_t(std::ranges::find(header, table.cells[i].column) - header.begin());
            const CellResult& cell = result.cells[i];
            row[column] = !cell.missing.empty() ? cell.missing
                          : table.unit == "maps"
                              ? fmt::format("{:.0f}\npaper: {:g}", cell.ours, cell.paper)
                              : fmt::format("{}, {:.2f} x\npaper: {:g} {}, {:.2f} x", spread(cell.cost_ms),
                                            cell.ours, table.cells[i].paper, table.unit, cell.paper);
        }
    }
    return fmt::format("<h2>{}: {}</h2>\n", html::escape(table.id), html::escape(table.title)) +
           html::table(header, rows) + paragraph("judgement", sentence(result)) +
           paragraph("paper", table.note) + paragraph("paper", standInNote(result.standIns));
}

std::string leftOutHtml(const std::vector<LeftOut>& leftOut) {
    if (leftOut.empty()) return "";
    const std::vector<std::string> header = {"", "why"};
    std::vector<std::vector<std::string>> rows;
    for (const LeftOut& one : leftOut) rows.push_back({one.what, one.why});
    return "<h2>What has no panel here</h2>\n" + html::table(header, rows);
}

}  // namespace

std::string toHtml(const PaperResult& result, const Machine& machine, const ReproductionOptions& options,
                   const std::string& command) {
    std::string body = fmt::format(
        "<p>{}</p>\n<p>The paper's hardware: {}. Ours: {}; {} ({}); costs are {} of the shadows alone, "
        "everything moving "
        "a little from frame to frame, medians and quartiles of {} rounds, ratios to the first of a figure "
        "or of the same view. "
        "A claim "
        "holds where our ratio is within the stated factor of the paper's or, where the paper has no "
        "numbers, in its "
        "order; a picture of which more than {:.0f} % is wrong holds none. {} x {} pixels, truth of {} rays "
        "a "
        "pixel; commit "
        "{}.<br><code>{}</code></p>\n",
        html::escape(result.paper.citation), html::escape(result.paper.hardware),
        html::escape(machine.processor), html::escape(machine.renderer), html::escape(machine.driver),
        html::escape(machine.clock), options.rounds, 100 * brokenShare, options.size.width_px,
        options.size.height_px, options.samples, html::escape(machine.commit), html::escape(command));
    for (const FigureResult& figure : result.figures) body += figureHtml(figure);
    for (const TableResult& table : result.tables) body += tableHtml(table);
    body += leftOutHtml(result.paper.leftOut);
    return html::page(result.paper.name + ", reproduced", body);
}

std::string judgements(const PaperResult& result) {
    std::string text = result.paper.name + "\n";
    for (const FigureResult& figure : result.figures) {
        for (const ClaimResult& claim : figure.claims)
            text += fmt::format("  {}: {}\n", figure.figure.id, sentence(claim));
        for (std::size_t i = 0; i < figure.panels.size(); ++i) {
            if (!figure.panels[i].missing.empty())
                text += fmt::format("  {}, {}: {}\n", figure.figure.id, figure.figure.panels[i].caption,
                                    figure.panels[i].missing);
        }
    }
    for (const TableResult& table : result.tables)
        text += fmt::format("  {}: {}\n", table.table.id, sentence(table));
    return text;
}

}  // namespace penumbra::studio
