// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/light_sampling/sample_cameras.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <limits>

#include "src/techniques/light_sampling/subdivision_io.h"

namespace penumbra::light_sampling {
namespace {

using Polygon = ReceiverRegion::Polygon;

constexpr double infinity = std::numeric_limits<double>::infinity();

glm::dmat3 lookAlong(const glm::dvec3& axis) {
    const glm::dvec3 upHint = std::abs(axis.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 right = glm::normalize(glm::cross(axis, upHint));
    return glm::transpose(glm::dmat3(right, glm::cross(right, axis), axis));
}

/// A sample near the horizon of its distant light's axis would slant the map without bound.
constexpr double steepestSlope = 50;

glm::dvec2 slopesOf(const glm::dvec3& towardsLightFace) {
    const glm::dvec2 slopes = glm::dvec2(towardsLightFace) / std::min(towardsLightFace.z, -1e-6);
    const double length = glm::length(slopes);
    return length > steepestSlope ? slopes * (steepestSlope / length) : slopes;
}

/// One map serves receivers up to 75 degrees off its axis. It wastes texels on the rim there, but less than
/// the six or so maps of a cube for every sample would cost.
constexpr double cosineOfHalfField = 0.259;

/// Whether every point of the box sees every receiver within that angle of the axis. The places from which
/// one point is seen within a cone are a cone themselves and convex: the box's corners tell for all of it.
bool fitsOneFace(const glm::dvec3& axis, std::span<const glm::dvec3> bounds,
                 std::span<const Polygon> receivers) {
    for (const Polygon& polygon : receivers) {
        for (const glm::dvec3& p : polygon) {
            for (const glm::dvec3& q : bounds) {
                if (!(glm::dot(p - q, axis) > cosineOfHalfField * glm::length(p - q))) return false;
            }
        }
    }
    return true;
}

/// Whether no receiver can lie in the pyramid that a cube's face sees, wherever in the box the cube's middle
/// is.
bool isEmptyFace(const glm::dmat3& faceFromLight, std::span<const glm::dvec3> bounds,
                 std::span<const Polygon> receivers) {
    const glm::dvec3 x = glm::row(faceFromLight, 0), y = glm::row(faceFromLight, 1),
                     z = glm::row(faceFromLight, 2);
    const std::array<glm::dvec3, 4> planes = {z - x, z + x, z - y, z + y};
    return std::ranges::all_of(receivers, [&](const Polygon& polygon) {
        return std::ranges::any_of(planes, [&](const glm::dvec3& plane) {
            double lowest = infinity;
            for (const glm::dvec3& q : bounds) lowest = std::min(lowest, glm::dot(plane, q));
            return std::ranges::all_of(polygon, [&](const auto& p) { return glm::dot(plane, p) < lowest; });
        });
    });
}

/// Under the sun; each takes its share of the memory.
constexpr int mostParts = 4;

double widthOf(std::span<const glm::dvec3> points) {
    glm::dvec2 low(infinity), high(-infinity);
    for (const glm::dvec3& p : points) {
        low = glm::min(low, glm::dvec2(p));
        high = glm::max(high, glm::dvec2(p));
    }
    return std::max(high.x - low.x, high.y - low.y);
}

}  // namespace

int SampleCameras::fitMaps(const AreaLight& light, const LightSurface& surface,
                           std::span<const LightSample> samples, const LightSpaceScene& scene, int mapSize_px,
                           double memory_texels) {
    // A single map has the memory of many: a light without size gets one as fine as `hard` has.
    constexpr int mostTimes = 4, largest_px = 16384;
    int size_px = surface.isPoint() ? mostTimes * mapSize_px : mapSize_px;
    fit(light, surface, samples, scene, std::min(size_px, largest_px));
    if (light.shape == LightShape::distant && !surface.isPoint()) {
        // Of blockers an eighth of the map's width away the shadows of samples that are neighbours in the
        // lattice lie a texel apart under a sun of this angle. Under a narrower one they fall together: fewer
        // samples, and finer maps of as many texels in all, see more.
        const double even_rad = double(latticeSide) * 8 / mapSize_px;
        const double finer =
            std::sqrt(even_rad / std::max(double(light.angle_rad), 1e-6) / std::max(1, faces));
        const double room = std::sqrt(memory_texels / double(std::max(1, faces))) / mapSize_px;
        size_px = int(std::clamp(std::min(finer, room), 1.0, double(mostTimes)) * mapSize_px);
        if (size_px > mapSize_px) fit(light, surface, samples, scene, std::min(size_px, largest_px));
    }
    return std::min(size_px, largest_px);
}

void SampleCameras::fit(const AreaLight& light, const LightSurface& surface,
                        std::span<const LightSample> samples, const LightSpaceScene& scene, int mapSize_px) {
    const std::span<const Polygon> polygons = scene.receivers.polygons;
    faces = 0;
    isCube = false;
    orthographic = light.shape == LightShape::distant;
    cameras.clear();
    if (polygons.empty()) return;

    const InlineVector<glm::dvec3, 8> bounds = surface.bounds();
    double farthest = 0;
    std::pmr::vector<glm::dvec3> directions{gl::ObjectRegistryScope::frameMemory()};
    for (const Polygon& polygon : polygons) {
        for (const glm::dvec3& p : polygon) {
            farthest = std::max(farthest, glm::length(p));
            if (p != glm::dvec3(0)) directions.push_back(glm::normalize(p));
        }
    }
    if (directions.empty()) return;
    for (const glm::dvec3& q : bounds) farthest = std::max(farthest, glm::length(q));

    if (orthographic) {
        faceFromLight[0] = lookAlong({0, 0, -1});
        near_m = infinity;
        far_m = -infinity;
        const auto include = [&](const glm::dvec3& p) {
            near_m = std::min(near_m, -p.z);
            far_m = std::max(far_m, -p.z);
        };
        for (const BoxCorners& box : scene.boxes) {
            if (!std::isnan(box[0].x)) std::ranges::for_each(box, include);
        }
        for (const Polygon& polygon : polygons) std::ranges::for_each(polygon, include);
        const double slack = 1e-3 * (far_m - near_m) + 1e-6 * farthest;
        near_m -= slack;
        far_m += slack;
    } else {
        // A float depth that tends to zero is as precise far away as it is near: the near plane may touch the
        // light.
        near_m = 1e-9 * farthest;
        far_m = 0;
        const glm::dvec3 axis = coneAxis(directions);
        if (fitsOneFace(axis, bounds, polygons)) {
            faces = 1;
            faceFromLight[0] = lookAlong(axis);
        } else {
            isCube = true;
            for (const glm::dvec3& faceAxis :
                 {glm::dvec3(0, 0, -1), glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0),
                  glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0)}) {
                const glm::dmat3 face = lookAlong(faceAxis);
                if (!isEmptyFace(face, bounds, polygons)) faceFromLight[std::size_t(faces++)] = face;
            }
        }
    }

    if (isCube) {
        const glm::dvec2 edge(1 + 4.0 / mapSize_px);
        for (const LightSample& sample : samples) {
            const glm::dvec3 place(sample.place);
            for (int face = 0; face < faces; ++face) {
                const glm::dmat3& rotation = faceFromLight[std::size_t(face)];
                glm::dmat4 camera(rotation);
                camera[3] = glm::dvec4(-(rotation * place), 1);
                add(camera, rotation * place, -edge, edge, mapSize_px);
            }
        }
        return;
    }
    if (orthographic) {
        takeReceivers(0, polygons);
        const double texel_m = widthOf(receivers_[0]) / mapSize_px;
        faces = 0;
        for (const ReceiverRegion::Polygons& part : partsByPixelSize(scene, texel_m, mostParts))
            takeReceivers(faces++, part);
    } else {
        takeReceivers(0, polygons);
    }
    fitWindows(samples, mapSize_px);
    nearestBlocker_m = near_m;
    if (orthographic) return;
    double nearest = infinity, foremost = -infinity;
    const auto depth = [&](const glm::dvec3& p) { return (faceFromLight[0] * p).z; };
    for (const BoxCorners& box : scene.boxes) {
        if (std::isnan(box[0].x)) continue;
        for (const glm::dvec3& p : box) nearest = std::min(nearest, depth(p));
    }
    for (const LightSample& sample : samples) foremost = std::max(foremost, depth(glm::dvec3(sample.place)));
    nearestBlocker_m = std::max(0.0, nearest - foremost);
}

void SampleCameras::takeReceivers(int part, std::span<const Polygon> polygons) {
    std::vector<glm::dvec3>& receivers = receivers_[std::size_t(part)];
    receivers.clear();
    for (const Polygon& polygon : polygons) {
        for (const glm::dvec3& p : polygon) receivers.push_back(faceFromLight[0] * p);
    }
    // Pieces share most of their corners.
    std::ranges::sort(receivers, [](const auto& a, const auto& b) {
        return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
    });
    receivers.erase(std::unique(receivers.begin(), receivers.end()), receivers.end());
}

void SampleCameras::fitWindows(std::span<const LightSample> samples, int mapSize_px) {
    for (const LightSample& sample : samples) {
        for (int face = 0; face < faces; ++face) fitWindow(sample, receivers_[std::size_t(face)], mapSize_px);
    }
}

void SampleCameras::fitWindow(const LightSample& sample, std::span<const glm::dvec3> receivers,
                              int mapSize_px) {
    const glm::dvec3 place = faceFromLight[0] * glm::dvec3(sample.place);
    const glm::dvec2 slopes = slopesOf(place);
    glm::dvec2 low(infinity), high(-infinity);
    for (const glm::dvec3& p : receivers) {
        const glm::dvec2 at =
            orthographic ? glm::dvec2(p) - slopes * p.z : glm::dvec2(p - place) / (p.z - place.z);
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    const glm::dvec2 extent = high - low;
    const double smallest = 1e-6 * (orthographic ? far_m - near_m : 1) + 1e-6 * std::max(extent.x, extent.y);
    const glm::dvec2 border = glm::max(extent, smallest) * (2.0 / std::max(1, mapSize_px - 4));
    glm::dmat4 camera(faceFromLight[0]);
    if (orthographic) {
        // Slanted along the light's direction: what lies on one ray falls on one place.
        glm::dmat3 slant(1);
        slant[2] = glm::dvec3(-slopes, 1);
        camera = glm::dmat4(slant * faceFromLight[0]);
    } else {
        camera[3] = glm::dvec4(-place, 1);
    }
    add(camera, orthographic ? glm::dvec3(slopes, 0) : place, low - border, high + border, mapSize_px);
}

void SampleCameras::add(const glm::dmat4& camera, const glm::dvec3& origin, glm::dvec2 windowMin,
                        glm::dvec2 windowMax, int mapSize_px) {
    const LightCameraConstants constants = LightCamera{.faceFromLight = camera,
                                                       .windowMin = windowMin,
                                                       .windowMax = windowMax,
                                                       .orthographic = orthographic,
                                                       .near_m = near_m,
                                                       .far_m = far_m}
                                               .constants(mapSize_px);
    cameras.push_back({constants, {origin, constants.depth.texelSize, constants.window}});
}

}  // namespace penumbra::light_sampling
