// SPDX-License-Identifier: Apache-2.0
// What floats cannot tell of large triangles: on which side a ray starts, and on which plane a receiver lies.
#pragma once

#include <glm/glm.hpp>

namespace penumbra::studio {

/// In world space.
struct TracedTriangle {
    glm::dvec3 a, b, c;

    glm::dvec3 normal() const { return glm::cross(b - a, c - a); }  ///< not unit; 0 without area

    /// Whether the ray crosses the triangle's plane at a distance in (0, end), in multiples of the direction.
    bool isCrossedWithin(const glm::dvec3& origin, const glm::dvec3& direction, double end) const;

    /// The triangle's point that is nearest to `place`.
    glm::dvec3 nearestTo(const glm::dvec3& place) const;
};

/// The plane of a rect or disk light. What lies in it hides nothing of the light (penumbra/light_plane.h).
struct LightPlane {
    glm::dvec3 center, axis;  ///< the axis is unit
    double reach_m;           ///< half the diagonal of the light's bounding rectangle

    bool contains(const TracedTriangle& triangle) const;
};

/// Of triangles that are seen one after another, the nearest to a place that lies across a normal.
class NearestPlane {
  public:
    /// Triangles farther away than `reach_m` do not count. `normal` is unit.
    NearestPlane(const glm::dvec3& place, const glm::dvec3& normal, double reach_m)
        : place_(place), point_(place), normal_(normal), distance_(reach_m) {}

    /// Whether the triangle is the nearest so far.
    bool take(const TracedTriangle& triangle);

    const glm::dvec3& place() const { return place_; }
    double distance() const { return distance_; }       ///< to the nearest so far, or `reach_m`
    const glm::dvec3& point() const { return point_; }  ///< the place, moved along the normal onto its plane

  private:
    glm::dvec3 place_, point_, normal_;
    double distance_;
};

}  // namespace penumbra::studio
