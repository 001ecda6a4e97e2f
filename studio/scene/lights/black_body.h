// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

namespace penumbra::studio {

/// Linear Rec. 709 of a black body of `temperature_K` (at least 1000), of luminance 1: as UsdLux's
/// colorTemperature. What lies outside Rec. 709 is clipped, at the same luminance.
glm::vec3 blackBodyColor(float temperature_K);

}  // namespace penumbra::studio
