// SPDX-License-Identifier: Apache-2.0
// Casters as light cameras see their bounding boxes: which of them may hide another.
#pragma once

#include <limits>
#include <memory_resource>
#include <span>
#include <vector>

#include "src/techniques/common/light_camera.h"

namespace penumbra {

/// Where a box is in a camera's window, and the greatest depth in it.
struct SeenBox {
    glm::dvec2 min{std::numeric_limits<double>::infinity()}, max{-min};
    double farthest_m = -std::numeric_limits<double>::infinity();
};

SeenBox seenBy(const LightCamera& camera, const BoxCorners& box);

/// The casters, without those that nothing receives behind, if any two of the rest overlap as a camera sees
/// them, so that one may be hidden by the other; else none. By their bounding boxes; as many as the
/// input's, those left out do not cast.
std::pmr::vector<Caster> overlappingCasters(const ShadowInputs& inputs, const LightSpaceScene& scene,
                                            std::span<const LightCamera> cameras);

}  // namespace penumbra
