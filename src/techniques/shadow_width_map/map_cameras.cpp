// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/shadow_width_map/map_cameras.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/techniques/common/overlapping_casters.h"
#include "src/techniques/shadow_width_map/shadow_width_io.h"

namespace penumbra::shadow_width_map {
namespace {

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
    return std::min(reach, double(widestMargin) * window);
}

/// The camera with a window of a grid of sizes and places and near and far planes of a grid of depths, around
/// the window that is wanted: views that differ little get the same bits. At most 8 % wider than that, which
/// is the resolution lost.
LightCamera steadied(LightCamera camera, const glm::dvec2& center, double half) {
    constexpr double sizesAnOctave = 16, placesAWindow = 32;
    const double least =
        2 * half / (1 - 1 / placesAWindow);  // that of which half a place to each side is spare
    const double size = std::exp2(std::ceil(sizesAnOctave * std::log2(least)) / sizesAnOctave);
    const double place = size / placesAWindow;
    const glm::dvec2 middle = place * glm::round(center / place);
    camera.windowMin = middle - 0.5 * size;
    camera.windowMax = middle + 0.5 * size;
    if (camera.orthographic) {
        const double step_m = std::exp2(std::floor(std::log2(camera.far_m - camera.near_m)) - 4);
        camera.near_m = step_m * std::floor(camera.near_m / step_m);
        camera.far_m = step_m * std::ceil(camera.far_m / step_m);
    } else {
        camera.near_m = std::exp2(std::floor(std::log2(camera.near_m)));
    }
    return camera;
}

void appendMatrix(std::pmr::vector<double>& key, const glm::dmat4& matrix) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) key.push_back(matrix[column][row]);
    }
}

}  // namespace

double planeBehindCasters_m(const ShadowInputs& inputs, const LightSpaceScene& scene,
                            std::span<const LightCamera> cameras) {
    double farthest_m = 0;
    for (const LightCamera& camera : cameras) {
        for (std::size_t i = 0; i < inputs.casters.size(); ++i) {
            if (inputs.casters[i].casts && camera.mightSee(scene.boxes[i]))
                farthest_m = std::max(farthest_m, seenBy(camera, scene.boxes[i]).farthest_m);
        }
    }
    return farthest_m;
}

LightCameras fitMapCameras(const AreaLight& light, const LightSpaceScene& scene, int mapSize_px,
                           bool splits) {
    LightCameras cameras =
        fitLightCameras(light, scene, {.mapSize_px = mapSize_px, .steadyAxis = true, .splits = splits});
    for (LightCamera& camera : cameras) {
        const glm::dvec2 extent = camera.windowMax - camera.windowMin;
        const double window = std::max(extent.x, extent.y);
        camera = steadied(camera, 0.5 * (camera.windowMin + camera.windowMax),
                          0.5 * window + penumbraReach(light, scene, camera, window));
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

}  // namespace penumbra::shadow_width_map
