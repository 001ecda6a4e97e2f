// SPDX-License-Identifier: Apache-2.0
// Turns recipes into pictures, measurements and sentences.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "studio/bench/contest.h"
#include "studio/papers/recipe.h"

namespace penumbra::studio {

struct PanelResult {
    std::string missing;  ///< "not yet: ..." where technique, parameter or buffer does not exist; else empty
    Image image;          ///< as it shall be shown
    std::optional<Spread> cost_ms;
    std::optional<double> penumbraError, maps;
    double wrongShare = 0;  ///< of umbra pixels that are lit, or of lit ones that are dark, whichever is more
};

/// With more than this wrong, a picture is visibly broken, and holds no claim.
inline constexpr double brokenShare = 0.05;

struct ClaimResult {
    std::string text;
    std::optional<double> ours;  ///< quantity of the lesser panel over that of the other, or its share; none:
                                 ///< not measured
    std::optional<double> paper;  ///< the same of the paper's numbers
    double factor = 1.5;          ///< see Claim
    bool isBroken = false;        ///< the lesser panel's picture is

    /// That the lesser panel has less.
    bool hasOrder() const { return ours && *ours < 1; }
    bool isNearPaper() const { return ours && paper && *ours <= *paper * factor && *paper <= *ours * factor; }
    bool holds() const { return !isBroken && (paper ? isNearPaper() : hasOrder()); }
};

struct FigureResult {
    Figure figure;
    std::vector<PanelResult> panels;
    std::vector<ClaimResult> claims;
    std::vector<std::string> standIns;  ///< "columns for sponza/Sponza.gltf"
    std::optional<Plot> plot = {};
};

struct CellResult {
    std::string missing;
    Spread cost_ms;
    double ours = 0, paper = 0;  ///< ratios of cost to the table's baseline; of maps: their numbers
};

struct TableResult {
    Table table;
    std::vector<CellResult> cells;
    std::vector<std::string> standIns;
};

struct PaperResult {
    Paper paper;
    std::vector<FigureResult> figures;
    std::vector<TableResult> tables;
};

struct ReproductionOptions {
    PictureSize size{480, 270};
    int samples = 128;             ///< rays a pixel of the truth
    int rounds = 3;                ///< measured ones, for each cost
    std::filesystem::path models;  ///< empty: built-in scenes stand in
    /// Called with the share that is done and what is being done.
    std::function<void(double, const std::string&)> progress = [](double, const std::string&) {};
};

/// Reproduces a whole paper. What does not exist yet is said in the results and ends nothing.
PaperResult reproduce(Workbench& workbench, const Paper& paper, const ReproductionOptions& options);

}  // namespace penumbra::studio
