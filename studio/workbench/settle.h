// SPDX-License-Identifier: Apache-2.0
// Pictures out of techniques that keep to a time are those of their steady state, and not of a first frame.
#pragma once

#include "studio/workbench/workbench.h"

namespace penumbra::studio {

/// Whether one of its budgets of time is set.
bool keepsToATime(Technique& technique);

/// Renders as many frames as it takes such techniques to find what fits; none where no light has one.
void settle(Workbench& workbench, const Workbench::TechniqueOf& techniqueOf, const SceneMoment& moment,
            const Camera& camera, PictureSize size);

/// How the technique that was chosen is set: what was told, and what its promise sets besides. Valid for
/// ever.
std::vector<penumbra::Setting> settingsOf(const Statistics::Chosen& chosen);

/// What a technique has chosen, "exact with samples = 144, stand_ins = true"; empty where it chooses nothing.
std::string describe(const Statistics::Chosen& chosen);

}  // namespace penumbra::studio
