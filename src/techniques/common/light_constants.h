// SPDX-License-Identifier: Apache-2.0
// What every technique has to know about a light, once.
#pragma once

#include "penumbra/light.h"
#include "src/device/glm_types.h"
#include "src/techniques/common/light_io.h"

namespace penumbra {

/// Half the light's width and height in metres, of a cylinder half its length and its radius; a distant
/// light's as the tangent of half its angle, which stays finite for half the sky: 87 degrees and more count
/// as 87.
glm::dvec2 lightExtent(const AreaLight& light);

/// More than a point or a direction.
bool hasSize(const AreaLight& light);

/// Rect and disk lights that emit along -Z alone.
bool isOneSided(const AreaLight& light);

LightConstants lightConstants(const AreaLight& light);

}  // namespace penumbra
