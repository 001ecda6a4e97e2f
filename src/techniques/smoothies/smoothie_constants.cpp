// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/smoothies/smoothie_constants.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/techniques/common/light_constants.h"

namespace penumbra::smoothies {
namespace {

/// Half the penumbra's smallest width. Edges are known exactly; it softens what is left of the texels between
/// them.
constexpr double smallestWidth_texels = 0.25;

/// How far away, along the camera's axis, the receivers reach.
double farthestReceiver_m(const LightCamera& camera, const LightSpaceScene& scene) {
    double farthest_m = 0;
    for (const ReceiverRegion::Polygon& polygon : scene.receivers.polygons) {
        for (const glm::dvec3& posLight : polygon) {
            farthest_m = std::max(farthest_m, (camera.faceFromLight * glm::dvec4(posLight, 1)).z);
        }
    }
    return farthest_m;
}

/// The light frustum that the paper's t is measured in, whatever the view shows of the scene: 90 degrees
/// wide, or, for want of a place to look from, as wide as all that casts.
struct LightFrustum {
    double half = 1;       ///< its window, in tangents or metres
    double nearest_m = 0;  ///< orthographic cameras: of all that casts, along their axis
};

LightFrustum lightFrustum(std::span<const Caster> casters, const LightCamera& camera,
                          const LightSpaceScene& scene) {
    if (!camera.orthographic) return {};
    constexpr double infinity = std::numeric_limits<double>::infinity();
    glm::dvec3 low(infinity), high(-infinity);
    for (std::size_t i = 0; i < casters.size(); ++i) {
        if (!casters[i].casts || std::isnan(scene.boxes[i][0].x)) continue;
        for (const glm::dvec3& corner : scene.boxes[i]) {
            const glm::dvec3 posFace = camera.faceFromLight * glm::dvec4(corner, 1);
            low = glm::min(low, posFace);
            high = glm::max(high, posFace);
        }
    }
    return {0.5 * std::max(high.x - low.x, high.y - low.y), low.z};
}

}  // namespace

SmoothieConstants smoothieConstants(const SmoothieSettings& settings, const ShadowInputs& inputs,
                                    const LightCamera& camera, const LightSpaceScene& scene) {
    const AreaLight& light = inputs.light;
    const glm::dmat3 faceFromLight(camera.faceFromLight);
    const bool rect = light.shape == LightShape::rect;
    const bool distant = light.shape == LightShape::distant;
    const glm::dvec2 extent = camera.windowMax - camera.windowMin;
    const double window = std::max(extent.x, extent.y);
    const double farthest_m = farthestReceiver_m(camera, scene);
    const LightFrustum frustum = lightFrustum(inputs.casters, camera, scene);
    // Edges much nearer to the light than to anything they shade: all of the window is in their penumbra
    // anyway.
    const double nearest_m = camera.orthographic ? camera.near_m : 1e-4 * farthest_m;
    return {
        .camera = camera.constants(settings.mapSize_px),
        .light = lightConstants(light),
        .halfX = faceFromLight[0] * double(rect ? 0.5f * light.width_m : light.radius_m),
        .radius = distant ? float(std::tan(0.5 * light.angle_rad)) : light.radius_m,
        .halfY = faceFromLight[1] * double(rect ? 0.5f * light.height_m : light.radius_m),
        .fixedWidth = float(settings.t * frustum.half),
        .smallestWidth = float(smallestWidth_texels * window / settings.mapSize_px),
        .largestWidth = float(window),
        .farthestReceiver = float(camera.orthographic ? -farthest_m : 1 / farthest_m),
        .nearestDrawn = float(camera.orthographic ? -nearest_m : 1 / nearest_m),
        .fixedFrom = float(-frustum.nearest_m),
        .falloff = settings.falloff,
        .isRemapped = settings.remap,
        .hasInnerHalf = settings.inner && settings.buffer == 0,
    };
}

}  // namespace penumbra::smoothies
