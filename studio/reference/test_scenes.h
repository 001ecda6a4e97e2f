// SPDX-License-Identifier: Apache-2.0
// Blockers, lights and receivers made by hand, for tests.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "studio/reference/reference.h"

namespace penumbra::studio {

/// A triangle soup under construction.
struct Soup {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;

    Soup& triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        for (const glm::vec3& corner : {a, b, c}) {
            indices.push_back(std::uint32_t(positions.size()));
            positions.push_back(corner);
        }
        return *this;
    }
    Soup& quad(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
        return triangle(a, b, c).triangle(a, c, d);
    }
    /// A rectangle at height z.
    Soup& rect(float x0, float x1, float y0, float y1, float z) {
        return quad({x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z});
    }
    Soup& box(const glm::vec3& lo, const glm::vec3& hi) {
        rect(lo.x, hi.x, lo.y, hi.y, lo.z).rect(lo.x, hi.x, lo.y, hi.y, hi.z);
        for (const float x : {lo.x, hi.x})
            quad({x, lo.y, lo.z}, {x, hi.y, lo.z}, {x, hi.y, hi.z}, {x, lo.y, hi.z});
        for (const float y : {lo.y, hi.y})
            quad({lo.x, y, lo.z}, {hi.x, y, lo.z}, {hi.x, y, hi.z}, {lo.x, y, hi.z});
        return *this;
    }
    /// A disc facing along the unit vector `axis`, of 4096 sides: its area is short by less than a part in a
    /// million.
    Soup& disc(const glm::vec3& center, const glm::vec3& axis, float radius) {
        const glm::vec3 other = std::abs(axis.x) < 0.5f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
        const glm::vec3 a = glm::normalize(glm::cross(axis, other)), b = glm::cross(axis, a);
        const auto rim = [&](int i) {
            const double angle = 2 * std::numbers::pi * i / 4096;
            return center + radius * (float(std::cos(angle)) * a + float(std::sin(angle)) * b);
        };
        for (int i = 0; i < 4096; ++i) triangle(center, rim(i), rim(i + 1));
        return *this;
    }
    /// Triangles of about `size`, anywhere in the box.
    Soup& random(int count, const glm::vec3& lo, const glm::vec3& hi, float size, std::uint32_t seed) {
        std::mt19937 generator(seed);
        const auto unit = [&] { return float(generator() >> 8) * 0x1p-24f; };
        const auto vector = [&] { return glm::vec3(unit(), unit(), unit()); };
        for (int i = 0; i < count; ++i) {
            const glm::vec3 center = glm::mix(lo, hi, vector());
            triangle(center + size * (vector() - 0.5f), center + size * (vector() - 0.5f),
                     center + size * (vector() - 0.5f));
        }
        return *this;
    }

    TracedCaster caster() const { return {.positions = positions, .indices = indices}; }
    ReferenceScene scene() const {
        const TracedCaster all = caster();
        return ReferenceScene({&all, 1});
    }
};

/// Large enough to be infinite here. Not larger, because a robust triangle test widens triangles by their
/// roundings: a blocker of a kilometre by a tenth of a millimetre.
inline constexpr float far_m = 10;

/// The same receiver at every pixel: as many independent estimates of one number.
inline ReceiverImage repeated(const glm::vec3& posWorld, const glm::vec3& normalWorld = {0, 0, 1},
                              int width = 16, int height = 16) {
    const std::size_t count = std::size_t(width) * height;
    return {.width_px = width,
            .height_px = height,
            .posWorld = std::vector(count, posWorld),
            .normalWorld = std::vector(count, normalWorld),
            .valid = std::vector<std::uint8_t>(count, 1),
            .eyeWorld = posWorld + glm::vec3(0, 0, 3)};
}

inline AreaLight lightAt(LightShape shape, const glm::vec3& posWorld) {
    AreaLight light{.shape = shape};
    light.worldFromLight.columns[3] = {posWorld.x, posWorld.y, posWorld.z, 1};
    return light;
}
/// A rect that shines down.
inline AreaLight rectAt(const glm::vec3& posWorld, float width_m, float height_m) {
    AreaLight light = lightAt(LightShape::rect, posWorld);
    light.width_m = width_m;
    light.height_m = height_m;
    return light;
}
/// A disk that shines down, or a sphere.
inline AreaLight roundAt(LightShape shape, const glm::vec3& posWorld, float radius_m) {
    AreaLight light = lightAt(shape, posWorld);
    light.radius_m = radius_m;
    return light;
}

/// A tube along X.
inline AreaLight tubeAt(const glm::vec3& posWorld, float length_m, float radius_m) {
    AreaLight light = lightAt(LightShape::cylinder, posWorld);
    light.length_m = length_m;
    light.radius_m = radius_m;
    return light;
}

}  // namespace penumbra::studio
