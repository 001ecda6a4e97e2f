// SPDX-License-Identifier: Apache-2.0
// What `penumbra bench` measured, and the forms in which it says so.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "studio/bench/axes.h"
#include "studio/bench/quality.h"

namespace penumbra::studio {

/// What numbers were taken on.
struct Machine {
    std::string processor;  ///< "Intel(R) ..., 2 cores"
    std::string renderer, driver;
    std::string clock;
    std::string commit;  ///< that this program was configured from
};
Machine thisMachine(const Workbench& workbench);

struct BenchReport {
    Machine machine;
    std::string scene;
    PictureSize size;
    bool moving = true;
    std::vector<ContestResult> results;  ///< on the scene
    std::vector<QualityPoint> quality;   ///< on the scene; may be empty
    std::vector<AxisResult> axes;        ///< on generated scenes; may be empty
};

/// The contract of `bench --json`.
nlohmann::ordered_json toJson(const BenchReport& report);

/// For a terminal: the scene, and who is on the front of error against cost.
std::string toTable(const BenchReport& report);

/// One line a number:
/// section,value,technique,ms_median,ms_low,ms_high,ratio_median,ratio_low,ratio_high,rounds, memory_bytes
std::string toCsv(const BenchReport& report);

/// Tables in Markdown: the scene, and for each axis the ratios and milliseconds.
std::string toMarkdown(const BenchReport& report);

/// Writes bench.json, bench.csv, tables.md, a plot for each axis (AXIS.svg) and of error against cost
/// (error-against-cost.svg), and report.html with all of it into `folder`, which must exist. Throws
/// OutputError.
void writeBench(const std::filesystem::path& folder, const BenchReport& report);

}  // namespace penumbra::studio
