// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "studio/measure/point_set.h"
#include "studio/scene/scene.h"

namespace penumbra::studio {

/// How many parts a light is measured as, along its width and height. What is seen of a light and what shines
/// there go together only where all of it sends alike to a point. A rectangle with a profile does not, where
/// it is seen large: it is cut into equal ones that the nearest of `points` sees a few degrees wide. All
/// others are one part.
glm::ivec2 partsWanted(const Light& light, const std::vector<MeasuringPoint>& points);

/// Those, of a rectangle if there is more than one.
std::vector<Light> partsOf(const Light& light, const glm::ivec2& counts);

}  // namespace penumbra::studio
