// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/shadow_width_map/map_cameras.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra {
namespace {

constexpr double widestMargin = 1.0 / 6;  // of the window

/// How far from its hard edge a penumbra can begin, in tangents or metres of the camera: see footprint.glsl.
/// A blocker that reaches the camera's plane makes it as wide as is allowed.
double penumbraReach(const AreaLight& light, const LightSpaceScene& scene, const LightCamera& camera,
                     double window) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const BoxCorners& box : scene.boxes) {
        if (!camera.mightSee(box)) continue;
        for (const glm::dvec3& corner : box) {
            const double depth = (camera.faceFromLight * glm::dvec4(corner, 1)).z;
            nearest = std::min(nearest, camera.orthographic ? depth : std::max(depth, 0.0));
        }
    }
    double reach = 0;
    if (camera.orthographic) {
        reach =
            std::tan(0.5 * std::min(double(light.angle_rad), 3.0)) * std::max(camera.far_m - nearest, 0.0);
    } else {
        const double extent = light.shape == LightShape::rect
                                  ? 0.5 * std::hypot(light.width_m, light.height_m)
                                  : double(light.radius_m);
        reach = extent == 0 ? 0 : extent / nearest;
    }
    return std::min(reach, widestMargin * window);
}

void appendMatrix(std::pmr::vector<double>& key, const glm::dmat4& matrix) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) key.push_back(matrix[column][row]);
    }
}

}  // namespace

LightCameras fitMapCameras(const AreaLight& light, const LightSpaceScene& scene, int mapSize_px) {
    LightCameras cameras = fitLightCameras(light, scene, {.mapSize_px = mapSize_px});
    for (LightCamera& camera : cameras) {
        const glm::dvec2 center = 0.5 * (camera.windowMin + camera.windowMax);
        const glm::dvec2 extent = camera.windowMax - camera.windowMin;
        const double window = std::max(extent.x, extent.y);
        const glm::dvec2 half(0.5 * window + penumbraReach(light, scene, camera, window));
        camera.windowMin = center - half;
        camera.windowMax = center + half;
    }
    return cameras;
}

void appendMapKey(std::pmr::vector<double>& key, const ShadowInputs& inputs, const LightSpaceScene& scene,
                  std::span<const LightCamera> cameras) {
    for (std::size_t i = 0; i < inputs.casters.size(); ++i) {
        const Caster& caster = inputs.casters[i];
        key.insert(key.end(), {double(caster.casts), double(caster.receives),
                               double(caster.alphaMask.texture), double(caster.alphaMask.revision),
                               double(caster.alphaMask.factor), double(caster.alphaMask.cutoff)});
        appendMatrix(key, scene.lightFromMesh[i]);
        key.insert(key.end(), {double(caster.mesh->id()), double(caster.mesh->revision())});
    }
    for (const LightCamera& camera : cameras) {
        appendMatrix(key, camera.faceFromLight);
        key.insert(key.end(), {camera.windowMin.x, camera.windowMin.y, camera.windowMax.x, camera.windowMax.y,
                               camera.near_m, camera.far_m});
    }
}

}  // namespace penumbra
