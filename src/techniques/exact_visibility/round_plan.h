// SPDX-License-Identifier: Apache-2.0
// Into how many rounds the work of resolve.comp.glsl may have to be divided.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "penumbra/light.h"
#include "src/techniques/exact_visibility/caster_soup.h"
#include "src/techniques/exact_visibility/exact_io.h"
#include "src/techniques/exact_visibility/light_lattice.h"

namespace penumbra::exact_visibility {

struct RoundPlan {
    std::size_t rows = 0;  ///< of the lattice that has most
    int groups = 1;        ///< of alpha textures, a turn each
    int paneSteps = 0;     ///< in which samples are taken through panes
    int turnRounds = 1;    ///< of a turn
    int rounds = 1;        ///< of all
};

/// For receivers that visit every node, project every triangle and look at every sample, as
/// resolve.comp.glsl counts that; `roundWork` is what a round does for one of them. `eye` is in the soup's
/// axes.
RoundPlan planRounds(const CasterSoup& soup, const AreaLight& light, const ExactLight& described,
                     std::span<const LightLattice> lattices, const glm::vec3& eye, std::size_t maskTextures,
                     int roundWork);

}  // namespace penumbra::exact_visibility
