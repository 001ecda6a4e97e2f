// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/gizmo.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "studio/scene/light_size.h"
#include "studio/viewer/light_editing.h"

namespace penumbra::studio::viewer {
namespace {

constexpr float armStart_px = 14, armLength_px = 74;
constexpr float ringRadius_px = 58;
constexpr float reach_px = 9;

glm::mat4 matrixOf(const AreaLight& light) {
    return std::bit_cast<glm::mat4>(light.worldFromLight);
}

void setMatrix(AreaLight& light, const glm::mat4& matrix) {
    light.worldFromLight = std::bit_cast<Mat4>(matrix);
}

/// Moving goes along the world's axes, turning and resizing along the light's own.
glm::vec3 axisOf(const AreaLight& light, Gizmo::Mode mode, Gizmo::Axis axis) {
    const int index = int(axis);
    if (mode != Gizmo::Mode::move) return glm::normalize(glm::vec3(matrixOf(light)[index]));
    glm::vec3 direction(0);
    direction[index] = 1;
    return direction;
}

/// Two directions across `axis`.
std::array<glm::vec3, 2> across(const glm::vec3& axis) {
    const glm::vec3 other = std::abs(axis.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 first = glm::normalize(glm::cross(axis, other));
    return {first, glm::cross(axis, first)};
}

std::vector<glm::vec3> circle(const glm::vec3& center, const glm::vec3& x, const glm::vec3& y, float radius) {
    constexpr int steps = 48;
    std::vector<glm::vec3> points;
    for (int i = 0; i <= steps; ++i) {
        const float angle = glm::two_pi<float>() * float(i) / steps;
        points.push_back(center + radius * (std::cos(angle) * x + std::sin(angle) * y));
    }
    return points;
}

/// The place along the line `point + s * axis` that is nearest to a ray; nothing where both are parallel.
std::optional<float> nearestAlong(const glm::vec3& point, const glm::vec3& axis, const Projection::Ray& ray) {
    const float cosine = glm::dot(axis, ray.direction);
    const float across2 = 1 - cosine * cosine;
    if (across2 < 1e-4f) return {};
    const glm::vec3 between = ray.origin - point;
    return (glm::dot(between, axis) - cosine * glm::dot(between, ray.direction)) / across2;
}

std::optional<glm::vec3> onPlane(const glm::vec3& point, const glm::vec3& normal,
                                 const Projection::Ray& ray) {
    const float slope = glm::dot(normal, ray.direction);
    if (std::abs(slope) < 1e-3f) return {};
    return ray.origin + glm::dot(normal, point - ray.origin) / slope * ray.direction;
}

float distanceToSegment(const glm::vec2& p, const glm::vec2& a, const glm::vec2& b) {
    const glm::vec2 along = b - a;
    const float length2 = glm::dot(along, along);
    const float t = length2 > 0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0f, 1.0f) : 0.0f;
    return glm::distance(p, a + t * along);
}

float snapped(float value, float step, bool snap) {
    return snap ? std::round(value / step) * step : value;
}

/// Which of its sizes a light's axis changes.
float AreaLight::*sizeAlong(const AreaLight& light, Gizmo::Axis axis) {
    switch (light.shape) {
        case LightShape::rect:
            return axis == Gizmo::Axis::y ? &AreaLight::height_m : &AreaLight::width_m;
        case LightShape::disk:
        case LightShape::sphere:
            return &AreaLight::radius_m;
        case LightShape::cylinder:
            return axis == Gizmo::Axis::x ? &AreaLight::length_m : &AreaLight::radius_m;
        case LightShape::distant:
            return &AreaLight::angle_rad;
    }
    return &AreaLight::radius_m;
}

/// How far from the place a distant light's disk of the sky is drawn at its size.
float skyDistance_m(const Bounds& scene) {
    return 1.4f * std::max(scene.radius(), 1e-3f);
}

/// Whether that size is the whole extent, and not half of it.
bool isWholeExtent(const AreaLight& light, Gizmo::Axis axis) {
    return light.shape == LightShape::rect || (light.shape == LightShape::cylinder && axis == Gizmo::Axis::x);
}

/// Half the extent along an axis, as it is drawn.
float halfExtent(const AreaLight& light, Gizmo::Axis axis, const Bounds& scene) {
    if (isWholeExtent(light, axis)) return 0.5f * light.*sizeAlong(light, axis);
    if (light.shape == LightShape::distant) return skyDistance_m(scene) * std::tan(0.5f * light.angle_rad);
    return light.radius_m;
}

}  // namespace

std::optional<glm::vec2> Projection::pixelOf(const glm::vec3& posWorld) const {
    const glm::dvec4 clip = camera_.clipFromView * camera_.viewFromWorld * glm::dvec4(posWorld, 1);
    if (clip.w <= 1e-6) return {};
    const glm::vec2 ndc(glm::dvec2(clip) / clip.w);
    return glm::vec2(0.5f + 0.5f * ndc.x, 0.5f - 0.5f * ndc.y) * size_px_;
}

Projection::Ray Projection::rayThrough(const glm::vec2& pixel) const {
    const glm::dvec2 ndc(2.0 * pixel.x / size_px_.x - 1, 1 - 2.0 * pixel.y / size_px_.y);
    const glm::dmat4 worldFromView = glm::inverse(camera_.viewFromWorld);
    const glm::dmat4& clip = camera_.clipFromView;
    if (camera_.orthographic) {
        const glm::dvec4 origin = worldFromView * glm::dvec4(ndc.x / clip[0][0], ndc.y / clip[1][1], 0, 1);
        return {glm::vec3(origin), -glm::vec3(worldFromView[2])};
    }
    const glm::dvec3 direction(ndc.x / clip[0][0], ndc.y / clip[1][1], -1);
    return {glm::vec3(worldFromView[3]), glm::vec3(glm::normalize(glm::dmat3(worldFromView) * direction))};
}

float Projection::pixelsPerMetre(const glm::vec3& posWorld) const {
    const glm::dvec4 view = camera_.viewFromWorld * glm::dvec4(posWorld, 1);
    const double depth_m = camera_.orthographic ? 1.0 : std::max(1e-6, -view.z);
    return float(0.5 * double(size_px_.y) * camera_.clipFromView[1][1] / depth_m);
}

glm::vec3 placeOf(const AreaLight& light, const Bounds& scene) {
    const glm::mat4 matrix = matrixOf(light);
    if (light.shape != LightShape::distant) return glm::vec3(matrix[3]);
    return scene.center() + skyDistance_m(scene) * glm::vec3(matrix[2]);
}

std::vector<std::vector<glm::vec3>> outlineOf(const AreaLight& light, const Bounds& scene) {
    const glm::mat4 matrix = matrixOf(light);
    const glm::vec3 x(matrix[0]), y(matrix[1]), z(matrix[2]), place = placeOf(light, scene);
    std::vector<std::vector<glm::vec3>> lines;
    if (light.shape == LightShape::rect) {
        const glm::vec3 w = 0.5f * light.width_m * x, h = 0.5f * light.height_m * y;
        lines.push_back({place - w - h, place + w - h, place + w + h, place - w + h, place - w - h});
    } else if (light.shape == LightShape::cylinder) {
        const glm::vec3 end = 0.5f * light.length_m * x;
        for (const glm::vec3& middle : {place - end, place + end})
            lines.push_back(circle(middle, y, z, light.radius_m));
        for (const glm::vec3& aside : {y, -y, z, -z})
            lines.push_back({place - end + light.radius_m * aside, place + end + light.radius_m * aside});
    } else {
        const float radius_m = halfExtent(light, Gizmo::Axis::x, scene);
        lines.push_back(circle(place, x, y, radius_m));
        if (light.shape == LightShape::sphere) {
            lines.push_back(circle(place, x, z, radius_m));
            lines.push_back(circle(place, y, z, radius_m));
        }
    }
    if (light.shape != LightShape::sphere && light.shape != LightShape::cylinder) {
        const float length_m = std::max(0.12f * scene.radius(), halfExtent(light, Gizmo::Axis::x, scene));
        lines.push_back({place, place - length_m * z});  // which way it shines
    }
    return lines;
}

std::vector<Gizmo::Handle> Gizmo::handles(const Light& light, Mode mode, const Projection& projection,
                                          const Bounds& scene, float scale) {
    std::vector<Handle> made;
    const AreaLight& shape = light.shape;
    const glm::vec3 place = placeOf(shape, scene);
    const std::optional<glm::vec2> center = projection.pixelOf(place);
    if (!center) return made;
    const float metresPerPixel = 1 / std::max(projection.pixelsPerMetre(place), 1e-9f);
    const bool distant = shape.shape == LightShape::distant;
    if (mode == Mode::move && distant) return made;  // it has no place

    for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
        const glm::vec3 direction = axisOf(shape, mode, axis);
        Handle handle{axis, {}};
        if (mode == Mode::turn) {
            const auto [u, v] = across(direction);
            for (const glm::vec3& point : circle(place, u, v, ringRadius_px * scale * metresPerPixel)) {
                if (const auto pixel = projection.pixelOf(point)) handle.line_px.push_back(*pixel);
            }
        } else if (mode == Mode::move) {
            // The middle is free for moving in the plane of the screen.
            const auto from = projection.pixelOf(place + armStart_px * scale * metresPerPixel * direction);
            const auto tip = projection.pixelOf(place + armLength_px * scale * metresPerPixel * direction);
            if (from && tip) handle.line_px = {*from, *tip};
        } else if (axis == Axis::x ||
                   (axis == Axis::y && sizeAlong(shape, axis) != sizeAlong(shape, Axis::x))) {
            const auto end = projection.pixelOf(place + halfExtent(shape, axis, scene) * direction);
            // Beyond the edge, so that a light of size zero can be taken hold of as well.
            const auto further = projection.pixelOf(
                place + (halfExtent(shape, axis, scene) + 26 * scale * metresPerPixel) * direction);
            if (end && further) handle.line_px = {*end, *further};
        }
        // What points at the eye cannot be pulled, and would lie over what can.
        const bool endOn = mode != Mode::turn && handle.line_px.size() == 2 &&
                           glm::distance(handle.line_px[0], handle.line_px[1]) < reach_px * scale;
        if (handle.line_px.size() > 1 && !endOn) made.push_back(std::move(handle));
    }
    if (mode == Mode::move) made.push_back({Axis::free, {*center, *center}});
    return made;
}

std::optional<Gizmo::Axis> Gizmo::pick(const std::vector<Handle>& handles, const glm::vec2& cursor_px,
                                       float scale) {
    std::optional<Axis> found;
    float nearest = reach_px * scale;
    for (const Handle& handle : handles) {
        for (std::size_t i = 1; i < handle.line_px.size(); ++i) {
            const float distance = distanceToSegment(cursor_px, handle.line_px[i - 1], handle.line_px[i]);
            if (distance >= nearest) continue;
            nearest = distance;
            found = handle.axis;
        }
    }
    return found;
}

void Gizmo::begin(const Light& light, Mode mode, Axis axis, const glm::vec2& cursor_px) {
    active_ = true;
    light_ = light;
    mode_ = mode;
    axis_ = axis;
    start_px_ = cursor_px;
}

Light Gizmo::drag(const glm::vec2& cursor_px, const Projection& projection, const Bounds& scene,
                  bool snap) const {
    switch (mode_) {
        case Mode::move:
            return moved(cursor_px, projection, scene, snap);
        case Mode::turn:
            return turned(cursor_px, projection, scene, snap);
        case Mode::resize:
            return resized(cursor_px, projection, scene);
    }
    return light_;
}

Light Gizmo::moved(const glm::vec2& cursor_px, const Projection& projection, const Bounds& scene,
                   bool snap) const {
    Light light = light_;
    const glm::vec3 place = placeOf(light.shape, scene);
    glm::vec3 way(0);
    if (axis_ == Axis::free) {
        const glm::vec3 facing = projection.rayThrough(start_px_).direction;
        const auto from = onPlane(place, facing, projection.rayThrough(start_px_));
        const auto to = onPlane(place, facing, projection.rayThrough(cursor_px));
        if (from && to) way = *to - *from;
    } else {
        const glm::vec3 axis = axisOf(light.shape, mode_, axis_);
        const auto from = nearestAlong(place, axis, projection.rayThrough(start_px_));
        const auto to = nearestAlong(place, axis, projection.rayThrough(cursor_px));
        if (from && to) way = snapped(*to - *from, 0.1f, snap) * axis;
    }
    glm::mat4 matrix = matrixOf(light.shape);
    matrix[3] += glm::vec4(way, 0);
    setMatrix(light.shape, matrix);
    return light;
}

Light Gizmo::turned(const glm::vec2& cursor_px, const Projection& projection, const Bounds& scene,
                    bool snap) const {
    Light light = light_;
    const glm::vec3 place = placeOf(light.shape, scene);
    const glm::vec3 axis = axisOf(light.shape, mode_, axis_);
    const auto from = onPlane(place, axis, projection.rayThrough(start_px_));
    const auto to = onPlane(place, axis, projection.rayThrough(cursor_px));
    if (!from || !to) return light;
    const auto [u, v] = across(axis);
    const auto angleOf = [&](const glm::vec3& point) {
        return std::atan2(glm::dot(point - place, v), glm::dot(point - place, u));
    };
    const float angle_rad = snapped(angleOf(*to) - angleOf(*from), glm::radians(15.0f), snap);
    glm::mat4 matrix = glm::rotate(glm::mat4(1), angle_rad, axis) * matrixOf(light.shape);
    matrix[3] = matrixOf(light.shape)[3];
    setMatrix(light.shape, matrix);
    light.sun.reset();  // it stands elsewhere now
    return light;
}

Light Gizmo::resized(const glm::vec2& cursor_px, const Projection& projection, const Bounds& scene) const {
    Light light = light_;
    const glm::vec3 place = placeOf(light.shape, scene);
    const glm::vec3 axis = axisOf(light.shape, mode_, axis_);
    const auto from = nearestAlong(place, axis, projection.rayThrough(start_px_));
    const auto to = nearestAlong(place, axis, projection.rayThrough(cursor_px));
    if (!from || !to) return light;
    const float half_m = std::max(0.0f, halfExtent(light.shape, axis_, scene) + *to - *from);
    const float size = isWholeExtent(light.shape, axis_) ? 2 * half_m
                       : light.shape.shape == LightShape::distant
                           ? std::min(2 * std::atan(half_m / skyDistance_m(scene)), glm::pi<float>())
                           : half_m;
    setSize(light, sizeAlong(light.shape, axis_), size);
    return light;
}

}  // namespace penumbra::studio::viewer
