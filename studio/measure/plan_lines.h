// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "studio/measure/point_set.h"

namespace penumbra::studio {

/// What of a scene a plan shows, in metres across and along the grid's frame.
struct PlanLines {
    using Line = std::array<glm::dvec2, 2>;
    std::vector<Line> cut;   ///< where the plane of the grid goes through surfaces
    std::vector<Line> seen;  ///< edges near it, below and above: borders, and where faces meet at an angle
};

/// Lines that lie farther than `margin_m` beside the grid are left out.
PlanLines planLinesOf(const Scene& scene, const SceneMoment& moment, const GridFrame& frame, double margin_m);

}  // namespace penumbra::studio
