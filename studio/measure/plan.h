// SPDX-License-Identifier: Apache-2.0
// A plan to read numbers off: values in colours, lines of equal value with their numbers, what stands there,
// and a scale.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "studio/image/image.h"
#include "studio/measure/isolines.h"
#include "studio/measure/plan_lines.h"

namespace penumbra::studio {

struct Plan {
    GridFrame frame;
    ValueGrid values;  ///< one a cell
    std::string unit;  ///< "lx", "h"
    std::string title;
    std::vector<std::string> notes;  ///< lines under the plan
    PlanLines lines;
    bool isAlongDown = true;  ///< row 1 is at the top
};

/// .png or .svg, by the file's name; UsageError for another. The file appears whole or not at all.
void writePlan(const std::filesystem::path& file, const Plan& plan, const Metadata& metadata);

/// Throws UsageError unless the name ends with .png or .svg.
void requirePlanName(const std::filesystem::path& file);

}  // namespace penumbra::studio
