// SPDX-License-Identifier: Apache-2.0
// The second truth: every ray against every triangle, in doubles, with no code in common with the first.
// Slow; it is there to be disagreed with.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "penumbra/light.h"
#include "studio/reference/reference.h"

namespace penumbra::studio {

class BruteForceScene {
  public:
    /// Alpha masks are ignored: every triangle is solid.
    explicit BruteForceScene(std::span<const TracedCaster> casters);

    /// Whether a triangle is hit at a distance in (0, end), in multiples of the direction.
    bool occluded(const glm::dvec3& origin, const glm::dvec3& direction, double end) const;

    /// Like ReferenceScene::trace for one receiver, area weight and no texture, with gridSize^2 regular
    /// samples of the light. The rays start exactly at `posWorld`, hence the receiver must not lie on a
    /// triangle.
    double visibility(const glm::dvec3& posWorld, const glm::dvec3& normalWorld, const AreaLight& light,
                      int gridSize) const;

  private:
    std::vector<std::array<glm::dvec3, 3>> triangles_;
};

}  // namespace penumbra::studio
