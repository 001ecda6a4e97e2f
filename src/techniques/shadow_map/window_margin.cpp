// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/shadow_map/window_margin.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/techniques/common/light_constants.h"

namespace penumbra::shadow_map {
namespace {

void widen(LightCamera& camera, const glm::dvec2& margin) {
    camera.windowMin -= margin;
    camera.windowMax += margin;
}

/// The distance of the nearest corner or face of the box's bounds from the light's centre; 0 inside.
double distanceTo(const BoxCorners& box) {
    glm::dvec3 low = box[0], high = box[0];
    for (const glm::dvec3& corner : box) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
    return glm::length(glm::max(glm::max(low, -high), glm::dvec3(0)));
}

}  // namespace

void widenByTexels(std::span<LightCamera> cameras, double texels, int mapSize_px) {
    for (LightCamera& camera : cameras) {
        const double inside_px = std::max(1.0, mapSize_px - 2 * texels);
        widen(camera, (camera.windowMax - camera.windowMin) * (texels / inside_px));
    }
}

void widenForLight(std::span<LightCamera> cameras, const AreaLight& light, const LightSpaceScene& scene) {
    // A blocker at the distance d beside the segment from the centre to a receiver, at most the light's
    // radius times 1 - d / D beside it, is seen that much over d away from the receiver: at most radius / d.
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const BoxCorners& box : scene.boxes) {
        if (!std::isnan(box[0].x)) nearest_m = std::min(nearest_m, distanceTo(box));
    }
    const double radius = glm::length(glm::dvec2(lightExtent(light)));
    for (LightCamera& camera : cameras) {
        const double reach = camera.orthographic ? radius * (camera.far_m - camera.near_m)
                             : radius > 0        ? radius / nearest_m
                                                 : 0;
        widen(camera, glm::min(glm::dvec2(reach), 0.5 * (camera.windowMax - camera.windowMin)));
    }
}

}  // namespace penumbra::shadow_map
