// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/light_editing.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "studio/scene/builtin/placing.h"
#include "studio/scene/profiles/luminaire.h"
#include "studio/scene/sun/sun.h"

namespace penumbra::studio::viewer {
namespace {

/// How much of its emission's unit (nits, candela, lux) a light gives to a surface far off that faces it: the
/// area or the solid angle that it shows, or 1 for a light of size zero.
float effect(const AreaLight& shape) {
    constexpr float pi = std::numbers::pi_v<float>;
    switch (shape.shape) {
        case LightShape::rect:
            return shape.width_m * shape.height_m;
        case LightShape::disk:
        case LightShape::sphere:
            return pi * shape.radius_m * shape.radius_m;
        case LightShape::cylinder:
            return 2 * shape.radius_m * shape.length_m;
        case LightShape::distant: {
            const float sine = std::sin(0.5f * shape.angle_rad);
            return pi * sine * sine;
        }
    }
    return 0;
}

void setUnit(Light& light) {
    const bool hasSize = effect(light.shape) > 0;
    light.emission.unit = hasSize                                    ? Emission::Unit::nits
                          : light.shape.shape == LightShape::distant ? Emission::Unit::lux
                                                                     : Emission::Unit::candela;
}

}  // namespace

Light newLight(const glm::vec3& posWorld, const glm::vec3& normalWorld, float distance_m) {
    constexpr float sizeShare = 0.25f, illuminance_lux = 500;
    const float size_m = sizeShare * distance_m;
    return rectLight("new light", size_m, size_m, posWorld + distance_m * normalWorld, posWorld,
                     illuminance_lux);
}

void changeShape(Light& light, LightShape shape) {
    AreaLight& area = light.shape;
    if (area.shape == shape) return;
    const glm::mat4 worldFromLight = std::bit_cast<glm::mat4>(area.worldFromLight);
    const float distance_m = std::max(glm::length(glm::vec3(worldFromLight[3])), 0.1f);
    const glm::vec3 color = light.emission.value * effect(area);
    const bool wasDistant = area.shape == LightShape::distant;
    const float radius_m = area.shape == LightShape::rect ? 0.5f * std::sqrt(area.width_m * area.height_m)
                           : wasDistant                   ? distance_m * std::tan(0.5f * area.angle_rad)
                           : area.shape == LightShape::cylinder ? 0.5f * area.length_m
                                                                : area.radius_m;
    constexpr float slenderness = 20;  // of a tube of T8, 26 mm across, of 0.6 m
    area.shape = shape;
    area.width_m = area.height_m = shape == LightShape::rect ? 2 * radius_m : 0;
    area.length_m = shape == LightShape::cylinder ? 2 * radius_m : 0;
    area.radius_m = shape == LightShape::disk || shape == LightShape::sphere ? radius_m
                    : shape == LightShape::cylinder                          ? radius_m / slenderness
                                                                             : 0;
    area.angle_rad = shape == LightShape::distant ? 2 * std::atan(radius_m / distance_m) : 0;
    if (shape != LightShape::rect) light.texture = -1;
    light.profile.reset();
    light.sun.reset();
    if (shape == LightShape::distant) light.cone_rad.reset();
    if (shape != LightShape::rect && shape != LightShape::disk) area.twoSided = false;
    // Candela at a distance are lux of a distant light.
    const float toLux = (shape == LightShape::distant) == wasDistant ? 1.0f
                        : wasDistant                                 ? distance_m * distance_m
                                                                     : 1 / (distance_m * distance_m);
    const float now = effect(area);
    light.emission.value = color * toLux / (now > 0 ? now : 1);
    setUnit(light);
}

void setSize(Light& light, float AreaLight::*size, float value) {
    if (light.profile && light.profile->isLuminaire) return;  // its size is its file's
    light.sun.reset();
    const float before = effect(light.shape);
    light.shape.*size = value;
    const float now = effect(light.shape);
    if ((before > 0) != (now > 0)) light.emission.value *= now > 0 ? 1 / now : before;
    setUnit(light);
}

Bearing bearingOf(const Light& light) {
    const glm::mat4 worldFromLight = worldFromLightOf(light);
    const glm::vec3 towards(worldFromLight[2]), x(worldFromLight[0]);
    constexpr float upright = 0.99999f;
    const float heading_rad =
        std::abs(towards.y) > upright ? std::atan2(x.z, x.x) : std::atan2(towards.x, -towards.z);
    return {glm::degrees(heading_rad), glm::degrees(std::asin(std::clamp(towards.y, -1.0f, 1.0f)))};
}

void setBearing(Light& light, const Bearing& bearing) {
    light.sun.reset();
    glm::mat4 matrix(worldFromDistantLight(bearing.azimuth_deg, bearing.altitude_deg));
    matrix[3] = worldFromLightOf(light)[3];
    place(light, matrix);
}

void aimAt(Light& light, const glm::vec3& target) {
    const glm::vec3 eye(worldFromLightOf(light)[3]);
    if (!(glm::distance(eye, target) > 1e-6f * (1 + glm::length(eye)))) return;
    light.sun.reset();
    place(light, worldFromLookAt(eye, target));
}

}  // namespace penumbra::studio::viewer
