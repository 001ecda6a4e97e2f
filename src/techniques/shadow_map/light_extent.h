// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "penumbra/light.h"
#include "src/techniques/common/glm_types.h"

namespace penumbra {

/// Half the light's width and height in metres; a distant light's as the tangent of half its angle, which
/// stays finite for half the sky: 87 degrees and more count as 87.
glm::dvec2 lightExtent(const AreaLight& light);

}  // namespace penumbra
