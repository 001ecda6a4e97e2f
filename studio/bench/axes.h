// SPDX-License-Identifier: Apache-2.0
// How cost grows: one property of a generated scene varies at a time.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "studio/bench/contest.h"

namespace penumbra::studio {

struct AxisInfo {
    std::string_view name;    ///< "triangles"
    std::string_view title;   ///< "triangles of the casters"
    std::vector<int> values;  ///< ascending; of "light-size" in millimetres, of "frame" the width of 16:9
    std::vector<int> small;   ///< those of a short bench
};
std::span<const AxisInfo> benchAxes();

struct AxisPoint {
    int value = 0;
    std::vector<ContestResult> results;  ///< of those who were not left out
};

struct AxisResult {
    AxisInfo axis;
    std::vector<AxisPoint> points;
    /// Who took longer than the limit at which value, and was left out of the larger ones.
    std::vector<std::pair<std::string, int>> leftOut;
};

struct AxisOptions {
    bool full = false;
    /// Called with the share that is done.
    std::function<void(double)> progress = [](double) {};
};

/// The picture's width and height, and everything else that does not vary: 480 x 270, 16 k triangles, one
/// light of 0.5 m, each technique's own map size. All moves from frame to frame.
AxisResult runAxis(Workbench& workbench, const AxisInfo& axis, std::span<const Contender> contenders,
                   const AxisOptions& options);

}  // namespace penumbra::studio
