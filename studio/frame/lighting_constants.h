// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "studio/frame/lighting_io.h"
#include "studio/scene/scene.h"

namespace penumbra::studio {

/// What shaders know of a light that stands at `worldFromLight` (a distant light's may stand anywhere, best
/// near the receivers); of its receivers, which are the caller's to state, nothing.
LightingConstants lightingConstants(const Light& light, const glm::dmat4& worldFromLight);

}  // namespace penumbra::studio
