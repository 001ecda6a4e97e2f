// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/light_editing.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "studio/scene/builtin/placing.h"
#include "studio/scene/light_size.h"
#include "studio/scene/profiles/luminaire.h"
#include "studio/scene/sun/sun.h"

namespace penumbra::studio::viewer {
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
    const glm::vec3 color = light.emission.value * effectOf(area);
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
    const float now = effectOf(area);
    light.emission.value = color * toLux / (now > 0 ? now : 1);
    setEmissionUnit(light);
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
