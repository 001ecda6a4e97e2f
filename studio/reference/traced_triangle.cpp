// SPDX-License-Identifier: Apache-2.0
#include "studio/reference/traced_triangle.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "penumbra/light_plane.h"

namespace penumbra::studio {
namespace {

/// Normals of one plane, one of them from a picture, make an angle of less than 2.6 degrees.
constexpr double sameDirection = 0.999;

glm::dvec3 nearestOfSegment(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& place) {
    const glm::dvec3 along = q - p;
    const double length2 = glm::dot(along, along);
    return length2 > 0 ? p + std::clamp(glm::dot(place - p, along) / length2, 0.0, 1.0) * along : p;
}

}  // namespace

bool TracedTriangle::isCrossedWithin(const glm::dvec3& origin, const glm::dvec3& direction,
                                     double end) const {
    const glm::dvec3 across = normal();
    const double distance = glm::dot(across, a - origin) / glm::dot(across, direction);
    return distance > 0 && distance < end;
}

glm::dvec3 TracedTriangle::nearestTo(const glm::dvec3& place) const {
    const glm::dvec3 across = normal();
    const auto isInside = [&](const glm::dvec3& p, const glm::dvec3& q) {
        return glm::dot(glm::cross(q - p, place - p), across) >= 0;
    };
    if (glm::dot(across, across) > 0 && isInside(a, b) && isInside(b, c) && isInside(c, a))
        return place - glm::dot(place - a, across) / glm::dot(across, across) * across;
    glm::dvec3 nearest = nearestOfSegment(a, b, place);
    for (const glm::dvec3& other : {nearestOfSegment(b, c, place), nearestOfSegment(c, a, place)}) {
        if (glm::distance(other, place) < glm::distance(nearest, place)) nearest = other;
    }
    return nearest;
}

bool LightPlane::contains(const TracedTriangle& triangle) const {
    return std::ranges::all_of(std::array{triangle.a, triangle.b, triangle.c}, [&](const glm::dvec3& corner) {
        const glm::dvec3 fromCenter = corner - center;
        return std::abs(glm::dot(axis, fromCenter)) <=
               double(lightPlaneTolerance) * (glm::length(fromCenter) + reach_m);
    });
}

bool NearestPlane::take(const TracedTriangle& triangle) {
    const double distance = glm::distance(triangle.nearestTo(place_), place_);
    if (!(distance < distance_)) return false;
    const glm::dvec3 across = triangle.normal();
    const double length = glm::length(across), along = glm::dot(across, normal_);
    if (!(std::abs(along) >= sameDirection * length) || length == 0) return false;
    distance_ = distance;
    point_ = place_ + glm::dot(triangle.a - place_, across) / along * normal_;
    return true;
}

}  // namespace penumbra::studio
