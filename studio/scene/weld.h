// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace penumbra::studio {

/// Gives positions that are at most `distance_m` apart the same bits, those of the first among them:
/// exporters round the two sides of a seam apart by an ulp, and a surface is closed where its positions are
/// equal. `surfaces` are the parts of one solid. Distances of zero or less change nothing.
void weld(std::span<const std::span<glm::vec3>> surfaces, float distance_m);

}  // namespace penumbra::studio
