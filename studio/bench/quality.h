// SPDX-License-Identifier: Apache-2.0
// What a user chooses by: error against cost, every technique at several qualities.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "studio/bench/judge.h"

namespace penumbra::studio {

/// Every technique of the catalog with its own knob of quality turned from low to high; the first is `hard`
/// with its defaults. Of the others only those that `asked` names.
std::vector<Contender> qualityLadder(std::span<const Contender> asked);

struct QualityPoint {
    Contender contender;
    double ratioToHard = 0;    ///< cost where everything moves
    double penumbra_rmse = 0;  ///< mean over the lights
    double leak = 0, false_shadow = 0;
    bool onFront = false;  ///< nobody is both nearer to the truth and cheaper
};

/// Measures error and cost. Contenders whose technique or parameter does not exist are left out. As judge().
std::vector<QualityPoint> measureQuality(Workbench& workbench, const Scene& scene, const SceneMoment& moment,
                                         const Camera& camera, PictureSize size,
                                         std::span<const Contender> contenders, int samples, int rounds,
                                         const std::function<void(double, const std::string&)>& progress);

}  // namespace penumbra::studio
