// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/dark_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "studio/scene/ray_cast.h"

namespace penumbra::studio {
namespace {

constexpr int rays = 128;
constexpr double most = 0.5, nearlyAll = 0.9;  ///< of the rays that could light something

/// Whether the ray goes on to another node behind what it met first.
bool isAnythingBehind(const std::vector<RayTriangle>& triangles, const glm::vec3& from,
                      const glm::vec3& direction, const RayHit& met) {
    constexpr float beyond = 1 + 1e-5f;
    RayHit hit = met;
    for (float distance_m = met.distance_m; hit.node == met.node; distance_m += hit.distance_m) {
        distance_m *= beyond;
        hit = nearestHit(triangles, from + distance_m * direction, direction);
    }
    return hit.node >= 0;
}

/// What stands first in the light's way, ray by ray: indices of nodes, -1 where nothing does, or where the
/// ray ends on what it lights: on a front with nothing behind it, as a ground's.
std::vector<int> metAround(const std::vector<RayTriangle>& casters, const std::vector<RayTriangle>& all,
                           const glm::mat4& worldFromLight, bool isFlat) {
    constexpr float golden = std::numbers::phi_v<float>;
    const glm::vec3 from(worldFromLight[3]);
    std::vector<int> met;
    for (int i = 0; i < rays; ++i) {
        // A spiral of equal areas over the sphere, or over the half of it that a flat light shines into.
        const float z = isFlat ? -(float(i) + 0.5f) / rays : 1 - 2 * (float(i) + 0.5f) / rays;
        const float around = 2 * std::numbers::pi_v<float> * golden * float(i), radius = std::sqrt(1 - z * z);
        const glm::vec3 direction =
            glm::mat3(worldFromLight) * glm::vec3(radius * std::cos(around), radius * std::sin(around), z);
        const RayHit hit = nearestHit(casters, from, direction);
        met.push_back(hit.isFront && !isAnythingBehind(all, from, direction, hit) ? -1 : hit.node);
    }
    return met;
}

std::vector<int> metOnTheWayTo(const std::vector<RayTriangle>& triangles, const glm::vec3& towards,
                               float beyond_m) {
    std::vector<int> met;
    const std::size_t step = std::max<std::size_t>(1, triangles.size() / rays);
    for (std::size_t i = 0; i < triangles.size(); i += step) {
        const glm::vec3 middle = triangles[i].a + (triangles[i].ab + triangles[i].ac) / 3.0f;
        const RayHit hit = nearestHit(triangles, middle + beyond_m * towards, -towards);
        constexpr float itself = 1e-4f;
        met.push_back(hit.distance_m < (1 - itself) * beyond_m ? hit.node : -1);
    }
    return met;
}

}  // namespace

std::string whyDark(const Scene& scene, const SceneMoment& moment, const Light& light) {
    if (!light.castsShadow) return "";
    const std::vector<RayTriangle> casters =
        rayTriangles(scene, moment, [](const Instance& instance) { return instance.casts; });
    if (casters.empty()) return "";
    const auto worldFromLight = std::bit_cast<glm::mat4>(light.shape.worldFromLight);
    const bool isDistant = light.shape.shape == LightShape::distant;
    const bool isFlat = light.shape.shape != LightShape::sphere &&
                        light.shape.shape != LightShape::cylinder && !light.shape.twoSided;
    const std::vector<int> met =
        isDistant ? metOnTheWayTo(casters, glm::vec3(worldFromLight[2]), 2 * moment.bounds.radius() + 1)
                  : metAround(casters, rayTriangles(scene, moment, [](const Instance&) { return true; }),
                              worldFromLight, isFlat);

    std::map<int, int> counts;
    for (const int node : met) ++counts[node];
    const auto first = std::ranges::max_element(
        counts, {}, [](const auto& entry) { return entry.first < 0 ? 0 : entry.second; });
    const double share = double(first->second) / double(met.size());
    if (first->first < 0 || share < most) return "";
    const std::string& name = scene.nodeNames[std::size_t(first->first)];
    return fmt::format(
        ": '{}' {} it; \"nodes\": {{\"{}\": {{\"casts\": false}}}} in the file of lights lets it through",
        name, share > nearlyAll && !isDistant ? "encloses" : "stands before", name);
}

}  // namespace penumbra::studio
