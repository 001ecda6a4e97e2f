// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "studio/reference/reference.h"
#include "studio/reference/traced_triangle.h"

namespace penumbra::studio {

/// Rays from one point, as separate arrays because that is how they are traced.
struct RayFan {
    std::vector<float> directionX, directionY, directionZ;
    std::vector<float> end;                ///< in multiples of the direction; infinity for none
    std::optional<LightPlane> lightPlane;  ///< what lies in it blocks nothing

    std::size_t size() const { return end.size(); }
    void resize(std::size_t count);
    void set(std::size_t ray, const glm::vec3& direction, float rayEnd) {
        directionX[ray] = direction.x;
        directionY[ray] = direction.y;
        directionZ[ray] = direction.z;
        end[ray] = rayEnd;
    }
};

/// Does anything block a ray? The one class that knows which ray tracing library is used, and its version.
class OcclusionScene {
  public:
    /// The indices must be in range.
    explicit OcclusionScene(std::span<const TracedCaster> casters);
    OcclusionScene(const OcclusionScene&) = delete;
    OcclusionScene& operator=(const OcclusionScene&) = delete;
    ~OcclusionScene();

    /// `posWorld` moved onto the plane of the nearest triangle that lies within `reach_m` of it and across
    /// `normalWorld` (unit); where there is none, `posWorld`. Casters that block nothing count, too.
    glm::dvec3 onSurface(const glm::dvec3& posWorld, const glm::dvec3& normalWorld, double reach_m) const;

    /// Whether something that blocks lets a share of the light pass.
    bool hasPanes() const;

    /// Sets `passing[i]` to the share of light that passes along ray i: none where it is blocked, all where
    /// nothing is in its way. Faster when rays that follow each other are close.
    void trace(const glm::vec3& origin, const RayFan& rays, std::span<glm::vec3> passing) const;

  private:
    struct Surface;
    struct Surfaces;
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace penumbra::studio
