// SPDX-License-Identifier: Apache-2.0
#include "studio/reference/brute_force.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace penumbra::studio {
namespace {

using glm::dvec3;
constexpr double pi = std::numbers::pi;

dvec3 column(const Mat4& matrix, std::size_t index) {
    const auto& c = matrix.columns[index];
    return {c[0], c[1], c[2]};
}

/// Möller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997, without culling.
bool hits(const std::array<dvec3, 3>& triangle, const dvec3& origin, const dvec3& direction, double end) {
    const dvec3 edge1 = triangle[1] - triangle[0], edge2 = triangle[2] - triangle[0];
    const dvec3 p = glm::cross(direction, edge2);
    const double determinant = glm::dot(edge1, p);
    if (determinant == 0) return false;
    const dvec3 fromCorner = origin - triangle[0];
    const double u = glm::dot(fromCorner, p) / determinant;
    const dvec3 q = glm::cross(fromCorner, edge1);
    const double v = glm::dot(direction, q) / determinant;
    const double t = glm::dot(edge2, q) / determinant;
    return u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < end;
}

/// A unit vector at `cosine` from the unit vector `axis`, turned by `angle` about it.
dvec3 around(const dvec3& axis, double cosine, double angle) {
    const dvec3 other = std::abs(axis.z) < 0.5 ? dvec3(0, 0, 1) : dvec3(1, 0, 0);
    const dvec3 a = glm::normalize(glm::cross(axis, other)), b = glm::cross(axis, a);
    return cosine * axis +
           std::sqrt(std::max(0.0, 1 - cosine * cosine)) * (std::cos(angle) * a + std::sin(angle) * b);
}

}  // namespace

BruteForceScene::BruteForceScene(std::span<const TracedCaster> casters) {
    for (const TracedCaster& caster : casters) {
        const glm::dmat4 worldFromMesh(caster.worldFromMesh);
        const auto corner = [&](std::size_t i) {
            return dvec3(worldFromMesh * glm::dvec4(caster.positions[caster.indices[i]], 1));
        };
        for (std::size_t i = 0; i + 2 < caster.indices.size(); i += 3) {
            triangles_.push_back({corner(i), corner(i + 1), corner(i + 2)});
        }
    }
}

bool BruteForceScene::occluded(const dvec3& origin, const dvec3& direction, double end) const {
    for (const auto& triangle : triangles_) {
        if (hits(triangle, origin, direction, end)) return true;
    }
    return false;
}

double BruteForceScene::visibility(const dvec3& posWorld, const dvec3& normalWorld, const AreaLight& light,
                                   int gridSize) const {
    const dvec3 x = column(light.worldFromLight, 0), y = column(light.worldFromLight, 1);
    const dvec3 z = column(light.worldFromLight, 2), toCenter = column(light.worldFromLight, 3) - posWorld;
    double seen = 0, whole = 0;
    for (int row = 0; row < gridSize; ++row) {
        for (int column = 0; column < gridSize; ++column) {
            const double s = (column + 0.5) / gridSize, t = (row + 0.5) / gridSize, turn = 2 * pi * s;
            dvec3 direction{0};
            double end = 1, part = 1;
            switch (light.shape) {
                case LightShape::rect:
                    direction = toCenter + (s - 0.5) * light.width_m * x + (t - 0.5) * light.height_m * y;
                    break;
                case LightShape::disk:
                    direction =
                        toCenter + light.radius_m * std::sqrt(t) * (std::cos(turn) * x + std::sin(turn) * y);
                    break;
                case LightShape::sphere: {
                    // A cone of directions; the ray ends where it meets the sphere first.
                    const double distance = glm::length(toCenter), radius = light.radius_m;
                    const double smallest = std::sqrt(1 - radius * radius / (distance * distance));
                    const double cosine = 1 - t * (1 - smallest);
                    const double offAxis2 = distance * distance * (1 - cosine * cosine);
                    direction = around(toCenter / distance, cosine, turn) *
                                (distance * cosine - std::sqrt(std::max(0.0, radius * radius - offAxis2)));
                    break;
                }
                case LightShape::distant:
                    direction = around(z, 1 - t * (1 - std::cos(light.angle_rad / 2.0)), turn);
                    end = std::numeric_limits<double>::infinity();
                    break;
                case LightShape::cylinder: {
                    // The side of it that faces the receiver. Its parts count what they cover of the plane
                    // through its two outer lines.
                    const double away = glm::length(toCenter - glm::dot(toCenter, x) * x);
                    const dvec3 ahead = (toCenter - glm::dot(toCenter, x) * x) / away;
                    const double outermost = std::acos(light.radius_m / away);
                    const double angle = outermost * (2 * t - 1);
                    const dvec3 outward = -std::cos(angle) * ahead + std::sin(angle) * glm::cross(x, ahead);
                    direction =
                        toCenter + (s - 0.5) * double(light.length_m) * x + double(light.radius_m) * outward;
                    // Its solid angle, over that of as much of the plane where one sees it.
                    const double stretch =
                        (away - light.radius_m * std::cos(outermost)) / glm::dot(direction, ahead);
                    part = -glm::dot(outward, direction) * stretch * stretch * stretch;
                    break;
                }
            }
            const bool flat = light.shape == LightShape::rect || light.shape == LightShape::disk;
            if (glm::dot(normalWorld, direction) <= 0) continue;
            if (flat && !light.twoSided && glm::dot(direction, z) <= 0) continue;
            whole += part;
            if (!occluded(posWorld, direction, end)) seen += part;
        }
    }
    return whole > 0 ? seen / whole : 0;
}

}  // namespace penumbra::studio
