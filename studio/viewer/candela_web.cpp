// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/candela_web.h"

#include "studio/scene/profiles/light_profile.h"
#include "studio/scene/profiles/luminaire.h"

namespace penumbra::studio::viewer {

std::vector<std::vector<glm::vec3>> candelaWeb(const Light& light, const Bounds& bounds) {
    const CandelaGrid& grid = light.profile->profile->grid;
    const double largest_cd = grid.largest();
    if (!(largest_cd > 0)) return {};
    const glm::dmat4 worldFromLight(worldFromLightOf(light));
    const double reach_m = bounds.radius() / 7, turn_deg = glm::degrees(double(light.profile->turn_rad));
    constexpr int step_deg = 3, betweenPlanes_deg = 45;
    std::vector<std::vector<glm::vec3>> lines;
    for (int plane = 0; plane < 180; plane += betweenPlanes_deg) {
        std::vector<glm::vec3>& line = lines.emplace_back();
        for (int gamma = -180; gamma <= 180; gamma += step_deg) {
            const double candela = grid.at(directionOf(gamma, plane));
            const glm::dvec3 out = directionOf(gamma, plane + turn_deg) * (reach_m * candela / largest_cd);
            line.emplace_back(worldFromLight * glm::dvec4(out, 1));
        }
    }
    return lines;
}

}  // namespace penumbra::studio::viewer
