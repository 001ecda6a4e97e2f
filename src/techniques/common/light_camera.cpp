// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/common/light_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <limits>
#include <optional>

#include "src/device/glm_types.h"
#include "src/techniques/common/view_constants.h"

namespace penumbra {
namespace {

using Polygon = ReceiverRegion::Polygon;
using Polygons = ReceiverRegion::Polygons;

/// The half-space of points p with dot(plane, (p, 1)) >= 0.
using Plane = glm::dvec4;
using Planes = InlineVector<Plane, 6>;

double signedDistance(const Plane& plane, const glm::dvec3& p) {
    return glm::dot(plane, glm::dvec4(p, 1));
}

/// Sutherland and Hodgman 1974.
Polygon clip(const Polygon& polygon, const Plane& plane) {
    Polygon result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3& a = polygon[i];
        const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
        const double da = signedDistance(plane, a);
        const double db = signedDistance(plane, b);
        if (da >= 0) result.push_back(a);
        if ((da >= 0) != (db >= 0)) result.push_back(glm::mix(a, b, da / (da - db)));
    }
    return result;
}

/// Adds to `result` what the planes leave of each.
void clip(std::span<const Polygon> polygons, std::span<const Plane> planes, Polygons& result) {
    for (Polygon polygon : polygons) {
        for (const Plane& plane : planes) polygon = clip(polygon, plane);
        if (!polygon.empty()) result.push_back(polygon);
    }
}

/// The faces of a hexahedron whose corner i has bit 0 for x, bit 1 for y, bit 2 for z.
std::array<Polygon, 6> facesOf(const BoxCorners& c) {
    return {{{c[0], c[2], c[6], c[4]},
             {c[1], c[5], c[7], c[3]},
             {c[0], c[4], c[5], c[1]},
             {c[2], c[3], c[7], c[6]},
             {c[0], c[1], c[3], c[2]},
             {c[4], c[6], c[7], c[5]}}};
}

/// Inward planes of the hexahedron's faces, oriented by its centre. A flat box has planes without a
/// direction, which clip nothing.
Planes planesOf(const BoxCorners& corners) {
    glm::dvec3 center(0);
    for (const glm::dvec3& corner : corners) center += corner / 8.0;
    Planes planes;
    for (const Polygon& face : facesOf(corners)) {
        const glm::dvec3 normal = glm::cross(face[2] - face[0], face[3] - face[1]);
        const double length = glm::length(normal);
        if (length == 0) continue;
        Plane plane(normal / length, -glm::dot(normal / length, face[0]));
        if (signedDistance(plane, center) < 0) plane = -plane;
        planes.push_back(plane);
    }
    return planes;
}

BoxCorners cornersOf(const Box& box, const glm::dmat4& targetFromBox) {
    BoxCorners corners;
    for (std::size_t i = 0; i < 8; ++i) {
        const glm::dvec3 corner((i & 1) ? box.max.x : box.min.x, (i & 2) ? box.max.y : box.min.y,
                                (i & 4) ? box.max.z : box.min.z);
        corners[i] = targetFromBox * glm::dvec4(corner, 1);
    }
    return corners;
}

/// The view frustum in light space, cut off at `far_m` where its far plane lies beyond (at infinity, say).
struct Frustum {
    BoxCorners corners;
    bool contains(const BoxCorners& box) const {
        const Planes planes = planesOf(corners);
        return std::ranges::all_of(box, [&](const glm::dvec3& p) {
            return std::ranges::all_of(planes,
                                       [&](const Plane& plane) { return signedDistance(plane, p) >= 0; });
        });
    }
};

Frustum frustumOf(const View& view, const glm::dmat4& lightFromWorld, double far_m) {
    const glm::dmat4 viewFromClip = glm::inverse(toGlm(view.clipFromView));
    const glm::dmat4 lightFromView = lightFromWorld * glm::inverse(toGlm(view.viewFromWorld));
    const double nearZ = view.depth.reversed                                     ? 1
                         : view.depth.range == DepthConvention::Range::zeroToOne ? 0
                                                                                 : -1;
    const double middleZ =
        view.depth.reversed && view.depth.range == DepthConvention::Range::minusOneToOne ? 0 : 0.5;
    Frustum frustum;
    for (std::size_t i = 0; i < 4; ++i) {
        // Two points on each edge of the frustum; the far one is moved along the edge to view-space z =
        // -far_m.
        const glm::dvec2 ndc((i & 1) ? 1 : -1, (i & 2) ? 1 : -1);
        const glm::dvec4 nearClip = viewFromClip * glm::dvec4(ndc, nearZ, 1);
        const glm::dvec4 middleClip = viewFromClip * glm::dvec4(ndc, middleZ, 1);
        const glm::dvec3 nearView = glm::dvec3(nearClip) / nearClip.w;
        const glm::dvec3 direction = glm::dvec3(middleClip) / middleClip.w - nearView;
        const double farther = std::max(0.0, (-far_m - nearView.z) / direction.z);
        frustum.corners[i] = lightFromView * glm::dvec4(nearView, 1);
        frustum.corners[i + 4] = lightFromView * glm::dvec4(nearView + farther * direction, 1);
    }
    return frustum;
}

glm::dmat4 lookAlong(const glm::dvec3& axis, const glm::dvec3& upHint, const glm::dvec3& originLight) {
    const glm::dvec3 right = glm::normalize(glm::cross(axis, upHint));
    const glm::dvec3 up = glm::cross(right, axis);
    glm::dmat4 faceFromLight(1);
    faceFromLight = glm::row(faceFromLight, 0, glm::dvec4(right, -glm::dot(right, originLight)));
    faceFromLight = glm::row(faceFromLight, 1, glm::dvec4(up, -glm::dot(up, originLight)));
    faceFromLight = glm::row(faceFromLight, 2, glm::dvec4(axis, -glm::dot(axis, originLight)));
    return faceFromLight;
}

/// A float depth that tends to zero is as precise far away as it is near: the near plane may all but touch
/// the light, this part of the farthest receiver's distance from it. Nearer points have no direction that
/// rounding would leave anything of: where a receiver touches the light, corners within an ulp or two of it.
constexpr double nearestOfFarthest = 1e-9;

/// Grows the window around everything in `polygons` that the camera has in front of it, then by the border.
/// Empty where nothing is.
std::optional<LightCamera> fitWindow(LightCamera camera, const Polygons& polygons,
                                     const LightCameraOptions& options) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    camera.windowMin = glm::dvec2(infinity);
    camera.windowMax = glm::dvec2(-infinity);
    double farthest = 0;
    for (const Polygon& polygon : polygons) {
        for (const glm::dvec3& p : polygon) {
            farthest = std::max(farthest, glm::length(glm::dvec3(camera.faceFromLight * glm::dvec4(p, 1))));
        }
    }
    if (farthest == 0) return std::nullopt;
    if (!camera.orthographic) camera.near_m = nearestOfFarthest * farthest;

    const Plane beyondNear = glm::row(camera.faceFromLight, 2) - Plane(0, 0, 0, camera.near_m);
    for (const Polygon& polygon : polygons) {
        for (const glm::dvec3& posLight : camera.orthographic ? polygon : clip(polygon, beyondNear)) {
            const glm::dvec3 p = camera.faceFromLight * glm::dvec4(posLight, 1);
            const glm::dvec2 place = camera.orthographic ? glm::dvec2(p) : glm::dvec2(p) / p.z;
            camera.windowMin = glm::min(camera.windowMin, place);
            camera.windowMax = glm::max(camera.windowMax, place);
        }
    }
    if (camera.windowMin.x > camera.windowMax.x) return std::nullopt;

    const glm::dvec2 extent = camera.windowMax - camera.windowMin;
    const double smallest = 1e-6 * (camera.orthographic ? farthest : 1) + 1e-6 * std::max(extent.x, extent.y);
    const glm::dvec2 border =
        glm::max(extent, smallest) * (2.0 / std::max(1, options.mapSize_px - 4)) + options.margin;
    camera.windowMin -= border;
    camera.windowMax += border;
    return camera;
}

/// The planes of the pyramid that a cube's face sees, a little wider so that neighbours overlap.
std::array<Plane, 4> pyramidOf(const glm::dmat4& faceFromLight) {
    const glm::dvec4 x = glm::row(faceFromLight, 0), y = glm::row(faceFromLight, 1);
    const glm::dvec4 z = 1.001 * glm::row(faceFromLight, 2);
    return {z - x, z + x, z - y, z + y};
}

LightCamera distantCamera(const LightSpaceScene& scene, const LightCameraOptions& options) {
    LightCamera camera;
    // A distant light's points are directions: originLight is the (unit) direction towards the point.
    const bool center = options.originLight == glm::dvec3(0);
    const glm::dvec3 axis = center ? glm::dvec3(0, 0, -1) : -options.originLight;
    camera.faceFromLight = lookAlong(axis, {0, 1, 0}, {});
    camera.orthographic = true;
    camera.near_m = std::numeric_limits<double>::infinity();
    camera.far_m = -camera.near_m;
    const auto include = [&](const glm::dvec3& posLight) {
        const double z = glm::dot(axis, posLight);
        camera.near_m = std::min(camera.near_m, z);
        camera.far_m = std::max(camera.far_m, z);
    };
    for (const BoxCorners& box : scene.boxes) {
        if (!std::isnan(box[0].x)) std::ranges::for_each(box, include);
    }
    for (const Polygon& polygon : scene.receivers.polygons) std::ranges::for_each(polygon, include);
    const double slack = 1e-3 * (camera.far_m - camera.near_m) + 1e-6;
    camera.near_m -= slack;
    camera.far_m += slack;
    return camera;
}

/// A window of a grid of sizes and places around the one that is wanted, so that texels stay where they are
/// while the view moves: at most 5 % wider.
LightCamera steadied(LightCamera camera, int mapSize_px) {
    constexpr double sizesAnOctave = 16;
    for (int axis = 0; axis < 2; ++axis) {
        const double least = (camera.windowMax[axis] - camera.windowMin[axis]) * (1 + 1.0 / mapSize_px);
        const double size = std::exp2(std::ceil(sizesAnOctave * std::log2(least)) / sizesAnOctave);
        const double texel = size / mapSize_px;
        camera.windowMin[axis] = texel * std::floor(camera.windowMin[axis] / texel);
        camera.windowMax[axis] = camera.windowMin[axis] + size;
    }
    return camera;
}

/// Orthographic cameras for parts of the receivers whose pixels differ little in size, the smallest pixels
/// first; one for all where its texels are no larger than the smallest pixel.
LightCameras splitByPixelSize(const LightCamera& whole, const LightSpaceScene& scene,
                              const LightCameraOptions& options) {
    constexpr int mostParts = 6;
    LightCameras cameras;
    const glm::dvec2 extent = whole.windowMax - whole.windowMin;
    const double texel_m = std::max(extent.x, extent.y) / options.mapSize_px;
    const std::pmr::vector<Polygons> parts = partsByPixelSize(scene, texel_m, mostParts);
    if (parts.size() == 1) {
        cameras.push_back(whole);
        return cameras;
    }
    for (const Polygons& part : parts) {
        if (auto fitted = fitWindow(whole, part, options))
            cameras.push_back(steadied(*fitted, options.mapSize_px));
    }
    return cameras;
}

/// Within five degrees of a direction, one of a few hundred.
glm::dvec3 onGrid(const glm::dvec3& direction) {
    constexpr double steps = 8;  // from the middle of a cube's face to its side
    const glm::dvec3 size = glm::abs(direction);
    return glm::normalize(glm::round(steps / std::max({size.x, size.y, size.z}) * direction));
}

}  // namespace

std::pmr::vector<Polygons> partsByPixelSize(const LightSpaceScene& scene, double texel_m, int mostParts) {
    std::pmr::vector<Polygons> parts(gl::ObjectRegistryScope::frameMemory());
    double smallest = std::numeric_limits<double>::infinity(), largest = 0;
    for (const Polygon& polygon : scene.receivers.polygons) {
        for (const glm::dvec3& p : polygon) {
            const double pixel_m = glm::dot(scene.pixelSize_m, glm::dvec4(p, 1));
            smallest = std::min(smallest, pixel_m);
            largest = std::max(largest, pixel_m);
        }
    }
    constexpr double leastRatio = 2;
    smallest = std::max(smallest, largest * std::pow(leastRatio, -mostParts));
    const int count =
        texel_m <= smallest
            ? 1
            : std::max(1, int(std::ceil(std::log(largest / smallest) / std::log(leastRatio) - 1e-9)));
    if (count == 1) {
        parts.push_back(scene.receivers.polygons);
        return parts;
    }
    const double ratio = std::pow(largest / smallest, 1.0 / count);
    double from_m = 0;
    for (int part = 1; part <= count; ++part) {
        const double to_m = part == count ? 2 * largest : smallest * std::pow(ratio, part);
        const std::array<Plane, 2> planes = {scene.pixelSize_m - Plane(0, 0, 0, from_m),
                                             Plane(0, 0, 0, to_m) - scene.pixelSize_m};
        Polygons inPart(gl::ObjectRegistryScope::frameMemory());
        clip(scene.receivers.polygons, planes, inPart);
        if (!inPart.empty()) parts.push_back(std::move(inPart));
        from_m = to_m;
    }
    return parts;
}

// M. Badoiu and K. Clarkson, Smaller core-sets for balls, 2003: step towards the farthest.
glm::dvec3 coneAxis(std::span<const glm::dvec3> directions) {
    glm::dvec3 axis = directions.front();
    for (int i = 1; i <= 64; ++i) {
        const auto farthest =
            std::ranges::min(directions, {}, [&](const auto& d) { return glm::dot(d, axis); });
        axis += (farthest - axis) / double(i + 1);
        if (glm::length(axis) < 1e-6) return directions.front();
    }
    return glm::normalize(axis);
}

LightSpaceScene makeLightSpaceScene(const ShadowInputs& inputs, const glm::dmat4& lightFromWorld) {
    LightSpaceScene scene;
    scene.light = lightConstants(inputs.light);
    double farthest_m = 0;
    const glm::dvec4 viewForwardLight =
        -glm::row(toGlm(inputs.view.viewFromWorld) * glm::inverse(lightFromWorld), 2);
    for (const Caster& caster : inputs.casters) {
        const glm::dmat4 lightFromMesh = lightFromWorld * toGlm(caster.worldFromMesh);
        const Box& box = caster.mesh->bounds();
        BoxCorners corners = cornersOf(box, lightFromMesh);
        if (box.min.x > box.max.x) corners.fill(glm::dvec3(std::numeric_limits<double>::quiet_NaN()));
        for (const glm::dvec3& corner : corners) {
            farthest_m = std::max(farthest_m, glm::dot(viewForwardLight, glm::dvec4(corner, 1)));
        }
        scene.boxes.push_back(corners);
        scene.lightFromMesh.push_back(lightFromMesh);
    }

    // A pixel is as many metres wide as the picture's clip-space w says.
    const glm::dmat4 clipFromView = toGlm(inputs.view.clipFromView);
    scene.pixelSize_m =
        glm::row(clipFromView * toGlm(inputs.view.viewFromWorld) * glm::inverse(lightFromWorld), 3) *
        (2 / (std::abs(clipFromView[1][1]) * inputs.view.height_px));

    // Intersection of two convex bodies, by its surface: the faces of each, clipped by the other.
    const Frustum frustum = frustumOf(inputs.view, lightFromWorld, 1.001 * farthest_m + 1e-6);
    const Planes frustumPlanes = planesOf(frustum.corners);
    const Plane emissionSide(0, 0, -1, 0);
    // The planes that cut a body, and on one-sided lights the light's own.
    const auto withEmission = [&](const Planes& planes) {
        InlineVector<Plane, 7> result;
        for (const Plane& plane : planes) result.push_back(plane);
        if (isOneSided(inputs.light)) result.push_back(emissionSide);
        return result;
    };
    for (std::size_t i = 0; i < inputs.casters.size(); ++i) {
        const BoxCorners& box = scene.boxes[i];
        if (!inputs.casters[i].receives || std::isnan(box[0].x)) continue;
        clip(facesOf(box), withEmission(frustumPlanes), scene.receivers.polygons);
        if (!frustum.contains(box)) {
            clip(facesOf(frustum.corners), withEmission(planesOf(box)), scene.receivers.polygons);
        }
    }
    return scene;
}

glm::dmat4 LightCamera::clipFromLight() const {
    const glm::dvec2 scale = 2.0 / (windowMax - windowMin);
    const glm::dvec2 shift = -scale * windowMin - 1.0;
    glm::dmat4 clipFromFace(0);
    clipFromFace[0][0] = scale.x;
    clipFromFace[1][1] = scale.y;
    if (orthographic) {
        clipFromFace[2][2] = -1 / (far_m - near_m);
        clipFromFace[3] = {shift, far_m / (far_m - near_m), 1};
    } else {
        clipFromFace[2] = {shift, 0, 1};
        clipFromFace[3][2] = near_m;
    }
    return clipFromFace * faceFromLight;
}

LightCameraConstants LightCamera::constants(int mapSize_px) const {
    const glm::dvec2 extent = windowMax - windowMin;
    return {
        .clipFromLight = clipFromLight(),
        .faceFromLight = faceFromLight,
        .window = {windowMin, 1.0 / extent},
        .depth = {float(near_m), float(far_m), orthographic,
                  float(std::max(extent.x, extent.y) / mapSize_px)},
    };
}

bool LightCamera::mightSee(const BoxCorners& box) const {
    const glm::dmat4 clip = clipFromLight();
    std::array<bool, 5> outside;
    outside.fill(true);
    for (const glm::dvec3& corner : box) {
        const glm::dvec4 p = clip * glm::dvec4(corner, 1);
        outside[0] = outside[0] && p.x < -p.w;
        outside[1] = outside[1] && p.x > p.w;
        outside[2] = outside[2] && p.y < -p.w;
        outside[3] = outside[3] && p.y > p.w;
        outside[4] = outside[4] && p.z > p.w;
    }
    return !std::isnan(box[0].x) && std::ranges::none_of(outside, [](bool all) { return all; });
}

LightCameras fitLightCameras(const AreaLight& light, const LightSpaceScene& scene,
                             const LightCameraOptions& options) {
    LightCameras cameras;
    const Polygons& receivers = scene.receivers.polygons;
    if (receivers.empty()) return cameras;
    if (light.shape == LightShape::distant) {
        const auto camera = fitWindow(distantCamera(scene, options), receivers, options);
        if (camera && options.splits) return splitByPixelSize(*camera, scene, options);
        if (camera) cameras.push_back(*camera);
        return cameras;
    }

    std::pmr::vector<glm::dvec3> directions(gl::ObjectRegistryScope::frameMemory());
    double farthest = 0;
    for (const Polygon& polygon : receivers) {
        for (const glm::dvec3& p : polygon) {
            farthest = std::max(farthest, glm::distance(p, options.originLight));
        }
    }
    for (const Polygon& polygon : receivers) {
        for (const glm::dvec3& p : polygon) {
            const double distance = glm::distance(p, options.originLight);
            if (distance > nearestOfFarthest * farthest) {
                directions.push_back((p - options.originLight) / distance);
            }
        }
    }
    if (directions.empty()) return cameras;
    const glm::dvec3 axis = coneAxis(directions);
    constexpr double cosineOfHalfField = 0.5;
    if (std::ranges::all_of(directions,
                            [&](const auto& d) { return glm::dot(d, axis) > cosineOfHalfField; })) {
        const glm::dvec3 lookAxis = options.steadyAxis ? onGrid(axis) : axis;
        const glm::dvec3 up = std::abs(lookAxis.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
        LightCamera camera{.faceFromLight = lookAlong(lookAxis, up, options.originLight)};
        if (auto fitted = fitWindow(camera, receivers, options)) cameras.push_back(*fitted);
        return cameras;
    }
    for (const glm::dvec3& faceAxis : {glm::dvec3(0, 0, -1), glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0),
                                       glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0)}) {
        const glm::dvec3 up = faceAxis.y == 0 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
        LightCamera camera{.faceFromLight = lookAlong(faceAxis, up, options.originLight)};
        Polygons inFace(gl::ObjectRegistryScope::frameMemory());
        clip(receivers, pyramidOf(camera.faceFromLight), inFace);
        if (auto fitted = fitWindow(camera, inFace, options)) cameras.push_back(*fitted);
    }
    return cameras;
}

}  // namespace penumbra
