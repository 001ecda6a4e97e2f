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

/// What a technique has chosen, "exact with samples = 144"; empty where it chooses nothing.
std::string describe(const Statistics::Chosen& chosen);

}  // namespace penumbra::studio
