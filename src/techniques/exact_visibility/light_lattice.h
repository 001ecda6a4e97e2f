// SPDX-License-Identifier: Apache-2.0
// Where on the light it is looked at: points of tilted square lattices.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace penumbra::exact_visibility {

/// Points of the square [-1, 1]^2, or of the disk in it, which all count the same: those with integer
/// coordinates (i, j) after uv has been turned, scaled and shifted. Tilted, so that an edge along an axis of
/// the light meets the samples one by one and not row by row.
struct LightLattice {
    glm::dmat2 latticeFromUv{1};
    glm::dvec2 offset{0};             ///< where uv = 0 lies
    std::vector<unsigned> validRows;  ///< bit i of row j: (i, j) is one of the samples

    glm::dvec2 uv(int i, int j) const;
};

/// As many lattices as it takes for none to have more than 256 points: together `samples` points, or one more
/// for each lattice after the first. All have the same matrix. `samples` of 1 is the centre.
std::vector<LightLattice> makeLightLattices(int samples, bool disk);

}  // namespace penumbra::exact_visibility
