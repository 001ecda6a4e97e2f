// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/profiles/luminaire.h"

#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

namespace penumbra::studio {

std::string makeLuminaire(std::shared_ptr<const LightProfile> profile, float turn_rad,
                          const glm::vec3& emission, Light& light) {
    const glm::mat4 worldFromLight = worldFromLightOf(light);
    NearestLight nearest = nearestLight(profile->opening, profile->grid.shinesUp());
    light.shape = nearest.shape;
    light.emission = {Emission::Unit::candela, emission};
    light.profile = {.profile = std::move(profile),
                     .isLuminaire = true,
                     .liesAlongY = nearest.liesAlongY,
                     .turn_rad = turn_rad};
    place(light, worldFromLight);
    return std::move(nearest.note);
}

void place(Light& light, const glm::mat4& worldFromLight) {
    glm::mat4 worldFromShape = worldFromLight;
    if (light.profile && light.profile->liesAlongY) {
        worldFromShape[0] = worldFromLight[1];
        worldFromShape[1] = -worldFromLight[0];
    }
    light.shape.worldFromLight = std::bit_cast<Mat4>(worldFromShape);
    if (!light.profile || !light.profile->isLuminaire) return;
    const glm::vec3 up(worldFromLight[2]);
    const double tilt_deg = glm::degrees(std::atan2(std::hypot(up.x, up.z), up.y));
    light.profile->tilt = float(light.profile->profile->tiltFactor(tilt_deg));
}

glm::mat4 worldFromLightOf(const Light& light) {
    const auto worldFromShape = std::bit_cast<glm::mat4>(light.shape.worldFromLight);
    glm::mat4 worldFromLight = worldFromShape;
    if (light.profile && light.profile->liesAlongY) {
        worldFromLight[0] = -worldFromShape[1];
        worldFromLight[1] = worldFromShape[0];
    }
    return worldFromLight;
}

float turnOfC0_rad(const ProfiledEmission& profile) {
    return profile.turn_rad - (profile.liesAlongY ? 0.5f * std::numbers::pi_v<float> : 0.0f);
}

}  // namespace penumbra::studio
