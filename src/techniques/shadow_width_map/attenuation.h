// SPDX-License-Identifier: Apache-2.0
// The attenuation function of Kirsch and Döllner 2003, section 3, as a table that the resolving shader looks
// up.
#pragma once

#include <functional>
#include <span>
#include <vector>

namespace penumbra::shadow_width_map {

/// I(sd, sw): the share of the light that arrives at shadow depth `sd` and shadow width `sw`, both >= 0. By
/// the paper's second property it depends on sw / sd alone, so that units do not matter.
using AttenuationFunction = std::function<float(float sd, float sw)>;

/// The ratio sw / sd at which the table ends; beyond, its last entry holds.
constexpr float attenuationTableEnd = 4;

/// Published: clamp(1 - sw / sd, 0, 1). Scale and bias are applied around it.
float linearAttenuation(float sd, float sw);
/// The same ends with flat tangents, as the penumbra of a round light has them.
float smoothAttenuation(float sd, float sw);

/// I(1, r) for r evenly from 0 to attenuationTableEnd. Throws Error::Kind::badArgument that names the
/// property of the paper's five that `attenuation` lacks, tried on a grid of depths and widths.
std::vector<float> tabulateAttenuation(const AttenuationFunction& attenuation);

/// The first ratio of the table at which no light is left; the table's end, if some always is.
float umbraBegins(std::span<const float> table);

}  // namespace penumbra::shadow_width_map
