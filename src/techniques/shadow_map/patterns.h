// SPDX-License-Identifier: Apache-2.0
// Where filters look: fixed sets of points, the same on every machine.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace penumbra::shadow_map {

/// Points of the unit disk that keep their distance from each other (Mitchell 1991: best candidates).
std::vector<glm::vec2> poissonDisk(int count);

/// Points spread evenly over the square [-1, 1]^2 (Hammersley's), so that an edge along either axis is
/// crossed by one after the other.
std::vector<glm::vec2> squarePattern(int count);

/// Points spread evenly over the unit disk (Vogel 1979: a golden-angle spiral).
std::vector<glm::vec2> diskPattern(int count);

/// Directions (xy, unit length) and distances (z, 0 to 1) that lie the denser the nearer they are to the
/// centre: equal numbers of them in rings of equal width. The first is the centre itself.
std::vector<glm::vec4> searchPattern(int count);

}  // namespace penumbra::shadow_map
