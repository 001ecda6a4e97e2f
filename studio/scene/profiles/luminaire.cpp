// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/profiles/luminaire.h"

#include <bit>
#include <cmath>
#include <utility>

namespace penumbra::studio {

std::string makeLuminaire(std::shared_ptr<const LightProfile> profile, float turn_rad,
                          const glm::vec3& emission, Light& light) {
    NearestLight nearest = nearestLight(profile->opening, profile->grid.shinesUp());
    light.shape = nearest.shape;
    light.emission = {Emission::Unit::candela, emission};
    light.profile = {.profile = std::move(profile), .isLuminaire = true, .turn_rad = turn_rad};
    return std::move(nearest.note);
}

void place(Light& light, const glm::mat4& worldFromLight) {
    light.shape.worldFromLight = std::bit_cast<Mat4>(worldFromLight);
    if (!light.profile || !light.profile->isLuminaire) return;
    const glm::vec3 up(worldFromLight[2]);
    const double tilt_deg = glm::degrees(std::atan2(std::hypot(up.x, up.z), up.y));
    light.profile->tilt = float(light.profile->profile->tiltFactor(tilt_deg));
}

}  // namespace penumbra::studio
