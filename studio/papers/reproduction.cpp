// SPDX-License-Identifier: Apache-2.0
#include "studio/papers/reproduction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "studio/bench/judge.h"
#include "studio/metrics/difference_image.h"
#include "studio/papers/buffer_picture.h"
#include "studio/papers/stage.h"

namespace penumbra::studio {
namespace {

/// What several panels or cells may share: a technique with its settings.
std::string keyOf(const std::string& technique, const Settings& settings) {
    std::string key = technique;
    for (const auto& [name, value] : settings) key += " " + name + "=" + value;
    return key;
}

/// All that was rendered and measured of one technique in one situation.
struct Rendering {
    std::string missing;
    Image display;
    std::vector<Image> visibilities;
    std::map<std::string, Image> buffers;  ///< by the name that was asked for
    std::optional<double> penumbraError, maps;
    std::optional<Spread> cost_ms;
    std::vector<PassTime> passes;
    double wrongShare = 0;  ///< see PanelResult
};

/// What part of all passes' time those take whose names have `part` in them.
std::optional<double> shareOf(std::span<const PassTime> passes, const std::string& part) {
    double named_ms = 0, all_ms = 0;
    for (const PassTime& pass : passes) {
        all_ms += pass.milliseconds;
        if (pass.name.find(part) != std::string_view::npos) named_ms += pass.milliseconds;
    }
    return all_ms > 0 ? std::optional(named_ms / all_ms) : std::nullopt;
}

double meanPenumbraError(const TechniqueComparison& technique) {
    double sum = 0;
    for (const LightComparison& light : technique.lights) sum += light.metrics.penumbra_rmse;
    return technique.lights.empty() ? 0 : sum / double(technique.lights.size());
}

double wrongShare(const TechniqueComparison& technique) {
    double largest = 0;
    for (const LightComparison& light : technique.lights)
        largest = std::max({largest, light.metrics.leak, light.metrics.false_shadow});
    return largest;
}

/// How many times the scene was drawn for the first light.
std::optional<double> mapsOf(const TechniqueComparison& technique) {
    if (technique.lights.empty()) return std::nullopt;
    for (const char* name : {"samples", "maps"}) {
        for (const auto& [count, value] : technique.lights.front().counts) {
            if (count == name) return value;
        }
    }
    return std::nullopt;
}

class Reproduction {
  public:
    Reproduction(Workbench& workbench, const ReproductionOptions& options)
        : workbench_(workbench), options_(options) {}

    FigureResult evaluate(const Figure& figure);
    TableResult evaluate(const Table& table);

  private:
    /// The technique and its settings where they exist; else says so in `missing`.
    bool exists(const Contender& contender, std::string& missing) {
        if (makeIfThere(workbench_, contender, missing) != nullptr) return true;
        missing = "not yet: " + missing;
        return false;
    }

    /// Opens the situation's scene unless it is open. `skipped` says why where it cannot be.
    StageView enter(const Situation& situation, std::vector<std::string>& standIns, std::string& skipped) {
        const std::string key =
            situation.scene + "|" + situation.model + (situation.placement ? "|placed" : "");
        if (key != openKey_) {
            stage_ = std::make_unique<Stage>(openStage(situation, options_.models));
            workbench_.open(stage_->scene);
            openKey_ = key;
        }
        if (!stage_->standIn.empty() && situation.placement) {
            skipped = fmt::format("skipped: {} is not among the models (--models)", situation.model);
        } else if (!stage_->standIn.empty()) {
            const std::string text = fmt::format("{} for {}", stage_->standIn, situation.model);
            if (std::ranges::find(standIns, text) == standIns.end()) standIns.push_back(text);
        }
        return viewOf(*stage_, situation);
    }

    /// How many maps each contender draws.
    std::map<std::string, double> maps(const StageView& view, const std::vector<Contender>& contenders);
    std::map<std::string, Spread> costs(const StageView& view, std::vector<Contender> contenders);
    std::map<std::string, Rendering> render(const Figure& figure, const Situation& situation,
                                            std::vector<std::string>& standIns);

    Workbench& workbench_;
    const ReproductionOptions& options_;
    std::string openKey_;
    std::unique_ptr<Stage> stage_;
};

/// By label; of those that exist.
std::map<std::string, Spread> Reproduction::costs(const StageView& view, std::vector<Contender> contenders) {
    std::map<std::string, Spread> costs_ms;
    if (contenders.empty()) return costs_ms;
    contenders.insert(contenders.begin(), {.label = "yardstick", .technique = "hard", .settings = {}});
    for (const ContestResult& result :
         runContest(workbench_, view.moment, view.camera, options_.size, contenders,
                    {.rounds = options_.rounds, .warmUpRounds = 1, .patience_ms = 6e3})) {
        if (result.missing.empty()) costs_ms[result.contender.label] = result.cost_ms;
    }
    return costs_ms;
}

std::map<std::string, double> Reproduction::maps(const StageView& view,
                                                 const std::vector<Contender>& contenders) {
    std::map<std::string, double> maps;
    const Comparison comparison = judge(workbench_, stage_->scene, view.moment, view.camera, options_.size,
                                        contenders, {.samples = 2, .timedRuns = 0});
    for (const TechniqueComparison& technique : comparison.techniques)
        maps[technique.technique] = mapsOf(technique).value_or(0);
    return maps;
}

/// Everything that the figure wants of one situation, by keyOf().
std::map<std::string, Rendering> Reproduction::render(const Figure& figure, const Situation& situation,
                                                      std::vector<std::string>& standIns) {
    std::string skipped;
    const StageView view = enter(situation, standIns, skipped);
    std::map<std::string, Rendering> renderings;
    if (!skipped.empty()) {
        for (const Panel& panel : figure.panels) {
            if (panel.situation == situation)
                renderings[keyOf(panel.technique, panel.settings)].missing = skipped;
        }
        renderings["reference"].missing = skipped;
        return renderings;
    }
    std::vector<Contender> contenders, timed;
    std::map<std::string, std::vector<std::string>> buffers;
    for (const Panel& panel : figure.panels) {
        if (panel.situation != situation || panel.technique == "reference") continue;
        const std::string key = keyOf(panel.technique, panel.settings);
        const Contender contender{.label = key, .technique = panel.technique, .settings = panel.settings};
        const bool first = !renderings.contains(key);
        Rendering& rendering = renderings[key];
        if (first && exists(contender, rendering.missing)) contenders.push_back(contender);
        if (panel.show == Show::buffer) buffers[key].push_back(panel.buffer);
        const bool known = std::ranges::find(timed, key, &Contender::label) != timed.end();
        if ((panel.timed || panel.paper) && rendering.missing.empty() && !known) timed.push_back(contender);
    }

    const auto inspect = [&](const Contender& contender, const Technique& technique) {
        renderings[contender.label].passes = technique.statistics().passes;
        for (const std::string& name : buffers[contender.label]) {
            if (std::optional<Image> picture = bufferPicture(technique, name, options_.size))
                renderings[contender.label].buffers[name] = std::move(*picture);
        }
    };
    Comparison comparison =
        judge(workbench_, stage_->scene, view.moment, view.camera, options_.size, contenders,
              {.samples = options_.samples, .timedRuns = 0, .inspect = inspect});
    for (TechniqueComparison& technique : comparison.techniques) {
        Rendering& rendering = renderings[technique.technique];
        if (figure.judged) {
            rendering.penumbraError = meanPenumbraError(technique);
            rendering.wrongShare = wrongShare(technique);
        }
        rendering.maps = mapsOf(technique);
        rendering.display = std::move(technique.display);
        for (LightComparison& light : technique.lights)
            rendering.visibilities.push_back(std::move(light.visibility));
    }
    Rendering& truth = renderings["reference"];
    truth.display = std::move(comparison.reference.display);
    truth.visibilities = std::move(comparison.reference.visibilities);
    for (const auto& [key, cost_ms] : costs(view, timed)) renderings[key].cost_ms = cost_ms;
    return renderings;
}

FigureResult Reproduction::evaluate(const Figure& figure) {
    FigureResult result{.figure = figure, .panels = {}, .claims = {}, .standIns = {}, .plot = {}};
    std::vector<std::pair<Situation, std::map<std::string, Rendering>>> all;
    const auto in = [&](const Situation& situation) -> std::map<std::string, Rendering>& {
        const auto found = std::ranges::find_if(all, [&](const auto& one) { return one.first == situation; });
        if (found != all.end()) return found->second;
        return all.emplace_back(situation, render(figure, situation, result.standIns)).second;
    };
    const auto renderingOf = [&](const Panel& panel) -> const Rendering& {
        return in(panel.situation)[keyOf(panel.technique, panel.settings)];
    };

    for (const Panel& panel : figure.panels) {
        const Rendering& rendering = renderingOf(panel);
        PanelResult& printed = result.panels.emplace_back();
        printed.missing = rendering.missing;
        if (!rendering.missing.empty()) continue;
        printed.cost_ms = rendering.cost_ms;
        printed.penumbraError = rendering.penumbraError;
        printed.maps = rendering.maps;
        printed.wrongShare = rendering.wrongShare;
        switch (panel.show) {
            case Show::picture:
                printed.image = rendering.display;
                break;
            case Show::visibility:
                printed.image = rendering.visibilities.front();
                break;
            case Show::buffer: {
                const auto found = rendering.buffers.find(panel.buffer);
                if (found == rendering.buffers.end()) {
                    printed.missing =
                        fmt::format("not yet: {} shows no buffer '{}'", panel.technique, panel.buffer);
                } else {
                    printed.image = found->second;
                }
                break;
            }
            case Show::difference: {
                const Rendering& base = panel.against ? renderingOf(figure.panels[*panel.against])
                                                      : in(panel.situation)["reference"];
                if (!base.missing.empty()) {
                    printed.missing = base.missing;
                } else {
                    printed.image = differenceImage(base.visibilities.front(), rendering.visibilities.front(),
                                                    panel.gain);
                }
                break;
            }
        }
    }
    if (figure.plot) {
        std::vector<Image> visibilities;
        for (const Panel& panel : figure.panels) {
            const Rendering& rendering = renderingOf(panel);
            if (rendering.missing.empty()) visibilities.push_back(rendering.visibilities.front());
        }
        if (visibilities.size() == figure.panels.size()) result.plot = figure.plot(visibilities);
    }
    for (const Claim& claim : figure.claims) {
        ClaimResult& judged = result.claims.emplace_back();
        judged.text = claim.text;
        judged.factor = claim.factor;
        const PanelResult &less = result.panels[claim.less], &more = result.panels[claim.more];
        judged.isBroken = less.wrongShare > brokenShare;
        const auto median = [](const PanelResult& panel) {
            return panel.cost_ms ? std::optional(panel.cost_ms->median) : std::nullopt;
        };
        const auto ratio = [](const std::optional<double>& a, const std::optional<double>& b) {
            return a && b && *b > 0 ? std::optional<double>(*a / *b) : std::nullopt;
        };
        if (claim.paper) judged.paper = claim.paper;
        switch (claim.quantity) {
            case Quantity::cost:
                judged.ours = ratio(median(less), median(more));
                if (!judged.paper)
                    judged.paper = ratio(figure.panels[claim.more].paper, figure.panels[claim.less].paper);
                break;
            case Quantity::penumbraError:
                judged.ours = ratio(less.penumbraError, more.penumbraError);
                break;
            case Quantity::maps:
                judged.ours = ratio(less.maps, more.maps);
                if (!judged.paper)
                    judged.paper =
                        ratio(figure.panels[claim.less].paperMaps, figure.panels[claim.more].paperMaps);
                break;
            case Quantity::passShare:
                judged.ours = shareOf(renderingOf(figure.panels[claim.less]).passes, claim.pass);
                break;
        }
    }
    return result;
}

TableResult Reproduction::evaluate(const Table& table) {
    TableResult result{.table = table, .cells = std::vector<CellResult>(table.cells.size()), .standIns = {}};
    // One contest a column, lest a whole table's maps are on the device at once.
    std::vector<std::pair<Situation, std::string>> columns;
    for (const Cell& cell : table.cells) {
        const std::pair column(cell.situation, cell.column);
        if (std::ranges::find(columns, column) == columns.end()) columns.push_back(column);
    }
    for (const auto& [situation, column] : columns) {
        std::string skipped;
        const StageView view = enter(situation, result.standIns, skipped);
        std::vector<Contender> contenders;
        for (std::size_t i = 0; i < table.cells.size(); ++i) {
            if (table.cells[i].situation != situation || table.cells[i].column != column) continue;
            if (!skipped.empty()) {
                result.cells[i].missing = skipped;
                continue;
            }
            const Contender contender{.label = std::to_string(i),
                                      .technique = table.cells[i].technique,
                                      .settings = table.cells[i].settings};
            if (exists(contender, result.cells[i].missing)) contenders.push_back(contender);
        }
        if (contenders.empty()) continue;
        if (table.unit == "maps") {
            for (const auto& [label, count] : maps(view, contenders))
                result.cells[std::size_t(std::stoi(label))].ours = count;
            continue;
        }
        const std::map<std::string, Spread> measured = costs(view, contenders);
        for (const Contender& contender : contenders) {
            result.cells[std::size_t(std::stoi(contender.label))].cost_ms = measured.at(contender.label);
        }
    }

    if (table.unit == "maps") {
        for (std::size_t i = 0; i < table.cells.size(); ++i) result.cells[i].paper = table.cells[i].paper;
        return result;
    }
    const auto paperCost = [&](const Cell& cell) {
        return table.unit == "fps" ? 1 / cell.paper : cell.paper;
    };
    for (std::size_t i = 0; i < table.cells.size(); ++i) {
        const auto base = std::ranges::find_if(table.cells, [&](const Cell& cell) {
            return table.baselineRow.empty() ||
                   (cell.row == table.baselineRow && cell.column == table.cells[i].column);
        });
        const auto baseIndex = std::size_t(base - table.cells.begin());
        const double base_ms = result.cells[baseIndex].cost_ms.median;
        result.cells[i].paper = paperCost(table.cells[i]) / paperCost(*base);
        if (base_ms > 0) result.cells[i].ours = result.cells[i].cost_ms.median / base_ms;
    }
    return result;
}

}  // namespace

PaperResult reproduce(Workbench& workbench, const Paper& paper, const ReproductionOptions& options) {
    Reproduction reproduction(workbench, options);
    PaperResult result{.paper = paper, .figures = {}, .tables = {}};
    const double parts = double(paper.figures.size() + paper.tables.size());
    double done = 0;
    for (const Figure& figure : paper.figures) {
        options.progress(done++ / parts, figure.id);
        result.figures.push_back(reproduction.evaluate(figure));
    }
    for (const Table& table : paper.tables) {
        options.progress(done++ / parts, table.id);
        result.tables.push_back(reproduction.evaluate(table));
    }
    return result;
}

}  // namespace penumbra::studio
