// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/default_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "studio/scene/builtin/placing.h"

namespace penumbra::studio {
namespace {

constexpr const char* name = "default";
constexpr int headings = 16, elevations = 5;
// A look around of 80 rays from five places costs some 0.4 s with this many triangles.
constexpr std::size_t maxTriangles = 200'000;
constexpr float eyeHeight_m = 1.6f;
constexpr float mostOfARoom =
    0.6f;  ///< of its height, for the eye in a room that is lower, or not of this world
constexpr float closedShare = 0.9f;     ///< of the rays that meet the front of a surface
constexpr float backedUpShare = 0.85f;  ///< of the way to the wall behind
constexpr float insideFov_rad = 1.1f;

struct Triangle {
    glm::vec3 a, ab, ac;
};

struct Hit {
    float distance_m = std::numeric_limits<float>::infinity();
    bool isFront = false;
};

std::optional<std::vector<Triangle>> trianglesOf(const Scene& scene, const SceneMoment& moment) {
    std::vector<Triangle> triangles;
    for (const Instance& instance : moment.instances) {
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        const std::vector<glm::vec3>& positions =
            instance.positions.empty() ? mesh.positions : instance.positions;
        if (triangles.size() + mesh.indices.size() / 3 > maxTriangles) return std::nullopt;
        const bool isMirrored = glm::determinant(glm::mat3(instance.worldFromMesh)) < 0;
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            std::array<glm::vec3, 3> corners;
            for (std::size_t k = 0; k < 3; ++k)
                corners[k] = instance.worldFromMesh * glm::vec4(positions[mesh.indices[i + k]], 1);
            if (isMirrored) std::swap(corners[1], corners[2]);
            triangles.push_back({corners[0], corners[1] - corners[0], corners[2] - corners[0]});
        }
    }
    return triangles;
}

// Moeller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997.
Hit nearest(const std::vector<Triangle>& triangles, const glm::vec3& from, const glm::vec3& direction) {
    Hit hit;
    for (const Triangle& triangle : triangles) {
        const glm::vec3 p = glm::cross(direction, triangle.ac);
        const float determinant = glm::dot(triangle.ab, p);
        if (determinant == 0) continue;
        const glm::vec3 s = from - triangle.a, q = glm::cross(s, triangle.ab);
        const float u = glm::dot(s, p) / determinant, v = glm::dot(direction, q) / determinant,
                    t = glm::dot(triangle.ac, q) / determinant;
        if (u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < hit.distance_m) hit = {t, determinant > 0};
    }
    return hit;
}

glm::vec3 towards(int heading, float elevation_rad) {
    const float angle = 2 * std::numbers::pi_v<float> * float(heading) / headings;
    return {std::cos(elevation_rad) * std::cos(angle), std::sin(elevation_rad),
            std::cos(elevation_rad) * std::sin(angle)};
}

struct View {
    glm::vec3 eye, target;
    float free_m = 0;
};

/// From one place in a closed room; nothing where the place is not in one.
std::optional<View> lookAround(const std::vector<Triangle>& triangles, const glm::vec3& place) {
    const Hit floor = nearest(triangles, place, {0, -1, 0}), ceiling = nearest(triangles, place, {0, 1, 0});
    if (!floor.isFront || !ceiling.isFront) return std::nullopt;
    const float height_m = floor.distance_m + ceiling.distance_m;
    const glm::vec3 eye =
        place + glm::vec3(0, std::min(eyeHeight_m, mostOfARoom * height_m) - floor.distance_m, 0);

    int fronts = 0;
    std::array<float, headings> free_m{};
    for (int heading = 0; heading < headings; ++heading)
        for (int i = 0; i < elevations; ++i) {
            const float elevation_rad = 0.5f * float(i - elevations / 2);
            const Hit hit = nearest(triangles, eye, towards(heading, elevation_rad));
            fronts += hit.isFront;
            if (elevation_rad == 0) free_m[std::size_t(heading)] = hit.distance_m;
        }
    if (float(fronts) < closedShare * headings * elevations) return std::nullopt;

    std::optional<View> best;
    for (int heading = 0; heading < headings; ++heading) {
        const float ahead_m = free_m[std::size_t(heading)];
        const float behind_m = backedUpShare * free_m[std::size_t((heading + headings / 2) % headings)];
        // Through a window one sees to the end of the world, which is not where one stands or looks.
        if (!std::isfinite(ahead_m) || !std::isfinite(behind_m)) continue;
        if (best && best->free_m >= ahead_m + behind_m) continue;
        const glm::vec3 direction = towards(heading, 0), from = eye - behind_m * direction;
        // A little downwards, where things stand and shadows fall.
        const glm::vec3 target =
            eye + ahead_m * direction - glm::vec3(0, 0.5f * (eye.y - (place.y - floor.distance_m)), 0);
        best = View{from, target, ahead_m + behind_m};
    }
    return best;
}

}  // namespace

Camera defaultCamera(const Scene& scene, const SceneMoment& moment, const Bounds& bounds) {
    const auto triangles = trianglesOf(scene, moment);
    if (!triangles || moment.bounds.empty()) return framingCamera(name, bounds);
    std::optional<View> best;
    // The middle may be taken by a table.
    for (const glm::vec2& share : {glm::vec2(0.5f, 0.5f), glm::vec2(0.3f, 0.3f), glm::vec2(0.7f, 0.3f),
                                   glm::vec2(0.3f, 0.7f), glm::vec2(0.7f, 0.7f)}) {
        const glm::vec3 place =
            glm::mix(moment.bounds.min, moment.bounds.max, glm::vec3(share.x, 0.5f, share.y));
        const std::optional<View> view = lookAround(*triangles, place);
        if (view && (!best || view->free_m > best->free_m)) best = view;
    }
    return best ? camera(name, best->eye, best->target, insideFov_rad) : framingCamera(name, bounds);
}

}  // namespace penumbra::studio
