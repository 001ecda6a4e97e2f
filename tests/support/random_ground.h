// SPDX-License-Identifier: Apache-2.0
// Grounds of all sizes with a box on them: what stands on a flat ground is shadowed as if the ground cast
// nothing.
#pragma once

#include <cstdint>
#include <string>

#include "studio/scene/scene.h"

namespace penumbra::studio {

struct RandomGround {
    Scene casting;    ///< the ground casts and receives
    Scene receiving;  ///< the same, but the ground casts nothing
    std::string description;
};

/// From 1 m to 10 km wide, of 1 to 10,000 triangles, level or tilted by up to 30 degrees, seen from 0.05 to
/// 100 m above it, under a light of any shape. Equal seeds make equal scenes.
RandomGround makeRandomGround(std::uint32_t seed);

}  // namespace penumbra::studio
