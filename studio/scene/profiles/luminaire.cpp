// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/profiles/luminaire.h"

#include <algorithm>
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

double widestPart_rad(const ProfiledEmission& profile) {
    constexpr double change = 0.2, narrowest_deg = 1, widest_deg = 10;
    const CandelaGrid& grid = profile.profile->grid;
    double steepest = 0;  // candela a degree
    const std::size_t verticals = grid.verticals_deg.size();
    for (std::size_t i = 0; i + 1 < grid.candela.size(); ++i) {
        if (i % verticals + 1 == verticals) continue;  // the next is another plane's first
        const double step_deg = grid.verticals_deg[i % verticals + 1] - grid.verticals_deg[i % verticals];
        steepest = std::max(steepest, std::abs(double(grid.candela[i + 1] - grid.candela[i])) / step_deg);
    }
    if (!(steepest > 0)) return glm::radians(widest_deg);
    const double stretched = profile.angleScale != 0 ? std::abs(double(profile.angleScale)) : 1;
    return glm::radians(
        std::clamp(stretched * change * double(grid.largest()) / steepest, narrowest_deg, widest_deg));
}

}  // namespace penumbra::studio
