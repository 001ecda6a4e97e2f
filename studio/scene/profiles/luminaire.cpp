// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/profiles/luminaire.h"

#include <bit>
#include <cmath>
#include <utility>

namespace penumbra::studio {

std::string makeLuminaire(std::shared_ptr<const LightProfile> profile, float turn_rad,
                          const glm::vec3& emission, Light& light) {
    const glm::mat4 worldFromLight = worldFromLightOf(light);
    NearestLight nearest =
        nearestLight(profile->opening, profile->grid.shinesUp(), profile->grid.isDarkAlongAxis());
    light.shape = nearest.shape;
    light.emission = {Emission::Unit::candela, emission};
    light.profile = {.profile = std::move(profile),
                     .isLuminaire = true,
                     .luminaireFromShape = nearest.luminaireFromShape,
                     .turn_rad = turn_rad};
    place(light, worldFromLight);
    return std::move(nearest.note);
}

void place(Light& light, const glm::mat4& worldFromLight) {
    const glm::mat4 lightFromShape(light.profile ? light.profile->luminaireFromShape : glm::mat3(1));
    light.shape.worldFromLight = std::bit_cast<Mat4>(worldFromLight * lightFromShape);
    if (!light.profile || !light.profile->isLuminaire) return;
    const glm::vec3 up(worldFromLight[2]);
    const double tilt_deg = glm::degrees(std::atan2(std::hypot(up.x, up.z), up.y));
    light.profile->tilt = float(light.profile->profile->tiltFactor(tilt_deg));
}

glm::mat4 worldFromLightOf(const Light& light) {
    const auto worldFromShape = std::bit_cast<glm::mat4>(light.shape.worldFromLight);
    if (!light.profile) return worldFromShape;
    return worldFromShape * glm::mat4(glm::transpose(light.profile->luminaireFromShape));
}

glm::vec3 towardsC0(const ProfiledEmission& profile) {
    return glm::transpose(profile.luminaireFromShape) *
           glm::vec3(std::cos(profile.turn_rad), std::sin(profile.turn_rad), 0);
}

glm::vec3 towardsZenith(const ProfiledEmission& profile) {
    return glm::transpose(profile.luminaireFromShape) * glm::vec3(0, 0, 1);
}

}  // namespace penumbra::studio
