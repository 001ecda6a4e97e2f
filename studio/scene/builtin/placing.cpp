// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/builtin/placing.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "studio/scene/lights/light_units.h"

namespace penumbra::studio {
namespace {

Light light(std::string name, LightShape shape, const glm::mat4& worldFromLight, float radiance_nits,
            const glm::vec3& color) {
    Light made;
    made.name = std::move(name);
    made.shape.shape = shape;
    made.shape.worldFromLight = std::bit_cast<Mat4>(worldFromLight);
    made.emission = {Emission::Unit::nits, radiance_nits * color};
    return made;
}

/// The bounds, or something to look at where there is nothing.
Bounds visible(const Bounds& bounds) {
    return bounds.radius() > 0 ? bounds : Bounds{bounds.center() - 0.5f, bounds.center() + 0.5f};
}

}  // namespace

glm::mat4 worldFromLookAt(const glm::vec3& eye, const glm::vec3& target) {
    const glm::vec3 back = glm::normalize(eye - target);
    const glm::vec3 up = std::abs(back.y) > 0.9999f ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0);
    const glm::vec3 right = glm::normalize(glm::cross(up, back));
    return {glm::vec4(right, 0), glm::vec4(glm::cross(back, right), 0), glm::vec4(back, 0),
            glm::vec4(eye, 1)};
}

Light rectLight(std::string name, float width_m, float height_m, const glm::vec3& eye,
                const glm::vec3& target, float illuminance_lux, const glm::vec3& color) {
    const float distance_m = glm::distance(eye, target);
    const float radiance_nits = illuminance_lux * distance_m * distance_m / (width_m * height_m);
    Light made = light(std::move(name), LightShape::rect, worldFromLookAt(eye, target), radiance_nits, color);
    made.shape.width_m = width_m;
    made.shape.height_m = height_m;
    return made;
}

Light diskLight(std::string name, float radius_m, const glm::vec3& eye, const glm::vec3& target,
                float illuminance_lux, const glm::vec3& color) {
    // Seen from its axis a disk fills the same cap of the sky as a distant light of its angle.
    const float angle_rad = 2 * std::atan(radius_m / glm::distance(eye, target));
    Light made = light(std::move(name), LightShape::disk, worldFromLookAt(eye, target),
                       radianceFromIlluminance_nits(illuminance_lux, angle_rad), color);
    made.shape.radius_m = radius_m;
    return made;
}

Light sphereLight(std::string name, float radius_m, const glm::vec3& center, const glm::vec3& target,
                  float illuminance_lux, const glm::vec3& color) {
    const float distance_m = glm::distance(center, target);
    const float intensity_cd = illuminance_lux * distance_m * distance_m;
    Light made = light(std::move(name), LightShape::sphere, worldFromLookAt(center, target),
                       radianceFromIntensity_nits(intensity_cd, radius_m), color);
    made.shape.radius_m = radius_m;
    return made;
}

Light tubeLight(std::string name, float length_m, float radius_m, const glm::vec3& center,
                const glm::vec3& target, float illuminance_lux, const glm::vec3& color) {
    const float distance_m = glm::distance(center, target);
    const float radiance_nits = illuminance_lux * distance_m * distance_m / (2 * radius_m * length_m);
    Light made =
        light(std::move(name), LightShape::cylinder, worldFromLookAt(center, target), radiance_nits, color);
    made.shape.length_m = length_m;
    made.shape.radius_m = radius_m;
    return made;
}

Light distantLight(std::string name, float angle_rad, const glm::vec3& direction, float illuminance_lux,
                   const glm::vec3& color) {
    Light made = light(std::move(name), LightShape::distant, worldFromLookAt(glm::vec3(0), direction),
                       radianceFromIlluminance_nits(illuminance_lux, angle_rad), color);
    made.shape.angle_rad = angle_rad;
    return made;
}

Camera camera(std::string name, const glm::vec3& eye, const glm::vec3& target, float yfov_rad) {
    return {std::move(name), worldFromLookAt(eye, target), yfov_rad, {}};
}

Camera framingCamera(std::string name, const Bounds& bounds) {
    const Bounds seen = visible(bounds);
    const glm::vec3 center = seen.center();
    const glm::vec3 towardsCamera = glm::normalize(glm::vec3(0.7f, 0.55f, 1));
    const float yfov_rad = 0.7f;
    const float reach = 0.95f * std::tan(0.5f * yfov_rad);  // a little room at the edges

    // A corner at (x, y, z) in a frame around the centre with z towards the camera fits when max(|x|, |y|) is
    // at most reach (d - z): each corner asks for a distance d.
    const glm::mat3 worldFromFrame(worldFromLookAt(center + towardsCamera, center));
    float distance_m = 0;
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 corner(i & 1 ? seen.max.x : seen.min.x, i & 2 ? seen.max.y : seen.min.y,
                               i & 4 ? seen.max.z : seen.min.z);
        const glm::vec3 inFrame = (corner - center) * worldFromFrame;  // times the transpose: its inverse
        distance_m =
            std::max(distance_m, inFrame.z + std::max(std::abs(inFrame.x), std::abs(inFrame.y)) / reach);
    }
    return camera(std::move(name), center + distance_m * towardsCamera, center, yfov_rad);
}

Light keyLight(std::string name, const Bounds& bounds, float illuminance_lux) {
    const Bounds lit = visible(bounds);
    const float distance_m = 2.5f * lit.radius();
    const glm::vec3 towardsLight = glm::normalize(glm::vec3(-0.6f, 1, 0.35f));
    return rectLight(std::move(name), 0.25f * distance_m, 0.25f * distance_m,
                     lit.center() + distance_m * towardsLight, lit.center(), illuminance_lux);
}

}  // namespace penumbra::studio
