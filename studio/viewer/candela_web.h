// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "studio/scene/scene.h"

namespace penumbra::studio::viewer {

/// A light's candela as lines in the world, as lighting designers draw them: in four planes through its axis,
/// as far from the light as it sends candela there; a seventh of the scene's radius at most. The light has a
/// profile.
std::vector<std::vector<glm::vec3>> candelaWeb(const Light& light, const Bounds& bounds);

}  // namespace penumbra::studio::viewer
