// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/smoothies/smoothie_constants.h"

#include <algorithm>
#include <cmath>

namespace penumbra {
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

}  // namespace

SmoothieConstants smoothieConstants(const SmoothieSettings& settings, const AreaLight& light,
                                    const LightCamera& camera, const LightSpaceScene& scene) {
    const glm::dmat3 faceFromLight(camera.faceFromLight);
    const bool rect = light.shape == LightShape::rect;
    const bool distant = light.shape == LightShape::distant;
    const glm::dvec2 extent = camera.windowMax - camera.windowMin;
    const double window = std::max(extent.x, extent.y);
    const double farthest_m = farthestReceiver_m(camera, scene);
    // Edges much nearer to the light than to anything they shade: all of the window is in their penumbra
    // anyway.
    const double nearest_m = camera.orthographic ? camera.near_m : 1e-4 * farthest_m;
    return {
        .camera = camera.constants(settings.mapSize_px),
        .halfX = glm::dvec4(faceFromLight[0] * double(rect ? 0.5f * light.width_m : light.radius_m), 0),
        .halfY = glm::dvec4(faceFromLight[1] * double(rect ? 0.5f * light.height_m : light.radius_m), 0),
        .widths = {distant ? std::tan(0.5 * light.angle_rad) : light.radius_m, 0.5 * settings.t * window,
                   smallestWidth_texels * window / settings.mapSize_px, window},
        .nearness = {camera.orthographic ? -farthest_m : 1 / farthest_m,
                     camera.orthographic ? -nearest_m : 1 / nearest_m, 0, 0},
        .settings = {int(light.shape), settings.falloff, settings.remap, settings.inner},
    };
}

}  // namespace penumbra
