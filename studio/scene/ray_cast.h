// SPDX-License-Identifier: Apache-2.0
// A few rays on the CPU, for questions about a scene that need no tree.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "studio/scene/scene.h"

namespace penumbra::studio {

/// In world space, its front the side from which it goes round anticlockwise.
struct RayTriangle {
    glm::vec3 a, ab, ac;
    int node = 0;  ///< index into Scene::nodeNames
};

struct RayHit {
    float distance_m = std::numeric_limits<float>::infinity();  ///< infinite: nothing is met
    bool isFront = false;
    int node = -1;
};

/// The triangles of the instances that `takes` holds for.
std::vector<RayTriangle> rayTriangles(const Scene& scene, const SceneMoment& moment,
                                      const std::function<bool(const Instance&)>& takes);

/// What a ray meets first; `direction` has unit length.
RayHit nearestHit(std::span<const RayTriangle> triangles, const glm::vec3& from, const glm::vec3& direction);

}  // namespace penumbra::studio
