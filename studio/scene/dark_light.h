// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "studio/scene/scene.h"

namespace penumbra::studio {

/// Why a light that casts shadows lights nothing, as the end of a sentence: ": 'Bulb' encloses it; ..." or
/// ": 'Roof' stands before it; ...", and the way to change it. Found with some rays from the light's centre
/// (a distant light's: to points of the scene). Empty where nothing stands before most of it.
std::string whyDark(const Scene& scene, const SceneMoment& moment, const Light& light);

}  // namespace penumbra::studio
