// SPDX-License-Identifier: Apache-2.0
// A view and a light in the words of this room's shaders.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "penumbra/light.h"
#include "penumbra/view.h"
#include "src/techniques/exact_visibility/exact_io.h"
#include "src/techniques/exact_visibility/light_lattice.h"

namespace penumbra::exact_visibility {

/// In axes whose origin lies at `originWorld`.
ExactFrame describeFrame(const View& view, const glm::dvec3& originWorld, int tileCapacity);

/// In the same axes; `lattices` holds one or more.
ExactLight describeLight(const AreaLight& light, const glm::dvec3& originWorld,
                         std::span<const LightLattice> lattices, bool isWeightedByIrradiance, int nodeCount);

/// By how much stand-ins may move a shadow's edge on the light, in metres; of distant lights, as the tangent
/// of an angle. 0 where they may not: what part of a picture, or of what it sends to the surface, an edge
/// meets there cannot be told beforehand.
float standInShift(const AreaLight& light, std::span<const LightLattice> lattices,
                   bool isWeightedByIrradiance);

}  // namespace penumbra::exact_visibility
