// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/default_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "studio/scene/builtin/placing.h"
#include "studio/scene/ray_cast.h"

namespace penumbra::studio {
namespace {

constexpr const char* name = "default";
constexpr int headings = 16, elevations = 5;
// A look around of 80 rays from five places costs some 0.4 s with this many triangles.
constexpr std::size_t maxTriangles = 200'000;
constexpr float eyeHeight_m = 1.6f;
constexpr float mostOfARoom = 0.6f;     ///< of its height, for the eye in a room that is lower
constexpr float leastRoom_m = 1.8f;     ///< what is lower holds no person: a vessel, a pipe, a housing
constexpr float closedShare = 0.9f;     ///< of the rays that meet the front of a surface
constexpr float backedUpShare = 0.85f;  ///< of the way to the wall behind
constexpr float insideFov_rad = 1.1f;

using Triangles = std::span<const RayTriangle>;

bool isTooMuch(const Scene& scene, const SceneMoment& moment) {
    std::size_t triangles = 0;
    for (const Instance& instance : moment.instances)
        triangles += scene.meshes[std::size_t(instance.mesh)].indices.size() / 3;
    return triangles > maxTriangles;
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
std::optional<View> lookAround(Triangles triangles, const glm::vec3& place) {
    const RayHit floor = nearestHit(triangles, place, {0, -1, 0}),
                 ceiling = nearestHit(triangles, place, {0, 1, 0});
    if (!floor.isFront || !ceiling.isFront) return std::nullopt;
    const float height_m = floor.distance_m + ceiling.distance_m;
    if (height_m < leastRoom_m) return std::nullopt;
    const glm::vec3 eye =
        place + glm::vec3(0, std::min(eyeHeight_m, mostOfARoom * height_m) - floor.distance_m, 0);

    int fronts = 0;
    std::array<float, headings> free_m{};
    for (int heading = 0; heading < headings; ++heading)
        for (int i = 0; i < elevations; ++i) {
            const float elevation_rad = 0.5f * float(i - elevations / 2);
            const RayHit hit = nearestHit(triangles, eye, towards(heading, elevation_rad));
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
    if (isTooMuch(scene, moment) || moment.bounds.empty()) return framingCamera(name, bounds);
    const std::vector<RayTriangle> triangles =
        rayTriangles(scene, moment, [](const Instance&) { return true; });
    std::optional<View> best;
    // The middle may be taken by a table.
    for (const glm::vec2& share : {glm::vec2(0.5f, 0.5f), glm::vec2(0.3f, 0.3f), glm::vec2(0.7f, 0.3f),
                                   glm::vec2(0.3f, 0.7f), glm::vec2(0.7f, 0.7f)}) {
        const glm::vec3 place =
            glm::mix(moment.bounds.min, moment.bounds.max, glm::vec3(share.x, 0.5f, share.y));
        const std::optional<View> view = lookAround(triangles, place);
        if (view && (!best || view->free_m > best->free_m)) best = view;
    }
    return best ? camera(name, best->eye, best->target, insideFov_rad) : framingCamera(name, bounds);
}

}  // namespace penumbra::studio
