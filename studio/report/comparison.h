// SPDX-License-Identifier: Apache-2.0
// What `penumbra compare` found, and the forms in which it says so.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "studio/image/image.h"
#include "studio/metrics/flicker.h"
#include "studio/metrics/visibility_metrics.h"

namespace penumbra::studio {

/// One technique on one light.
struct LightComparison {
    std::string light;
    VisibilityMetrics metrics;
    std::vector<double> milliseconds;  ///< of each timed render
    std::vector<std::pair<std::string, double>> counts;
    std::string chosen;  ///< by a technique that takes others, with the setting: "exact with samples = 144"
    std::optional<FlickerMetrics> flicker;  ///< where it was measured
    Image visibility;                       ///< 1 or 3 channels
};

struct TechniqueComparison {
    std::string technique;
    double flip = 0;  ///< mean LDR-FLIP of the final picture
    Image display;    ///< sRGB-encoded RGB
    std::vector<LightComparison> lights;
};

struct ReferenceSummary {
    int samples = 0;
    double noise_rms = 0;             ///< the largest of all lights
    double raysPerSecond = 0;         ///< when the traces were made; they may come from the cache
    Image display;                    ///< sRGB-encoded RGB
    std::vector<Image> visibilities;  ///< one a light, in the order of TechniqueComparison::lights
};

struct Comparison {
    std::string scene;
    int width_px = 0, height_px = 0;
    std::string renderer;  ///< GL_RENDERER, whose milliseconds these are
    std::string clock;     ///< what they are of, see CostClock
    std::string command;
    ReferenceSummary reference;
    std::vector<TechniqueComparison> techniques;
};

/// The contract of `compare --json`; errors in visibility units (0..1).
nlohmann::ordered_json toJson(const Comparison& comparison);

/// A table for a terminal: a row for each technique and light.
std::string toTable(const Comparison& comparison);

/// A row for each scene, technique and light, under a header; names and units as in toJson. Fields that were
/// not measured are empty.
std::string toCsv(std::span<const Comparison> comparisons);

/// Writes into `folder`, which must exist: for each technique its picture (TECHNIQUE.png), and for each light
/// its visibility, the signed difference to the truth x5, and the numbers of both (TECHNIQUE.visibility.exr,
/// with channels V, truth and error); the same pictures for the reference; contact-sheet.png; report.html.
/// Files of a light carry its name where there are several. Throws OutputError.
void writeComparison(const std::filesystem::path& folder, const Comparison& comparison,
                     const Metadata& metadata);

/// One page that opens from disk and holds its pictures: side by side, wiped over each other, and the table.
std::string toHtml(const Comparison& comparison);

}  // namespace penumbra::studio
