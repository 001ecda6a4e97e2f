// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/shadow_map/light_extent.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

glm::dvec2 lightExtent(const AreaLight& light) {
    switch (light.shape) {
        case LightShape::rect:
            return 0.5 * glm::dvec2(light.width_m, light.height_m);
        case LightShape::disk:
        case LightShape::sphere:
            return glm::dvec2(light.radius_m);
        case LightShape::distant:
            break;
    }
    constexpr double widest_rad = 1.52;
    return glm::dvec2(std::tan(std::min(0.5 * double(light.angle_rad), widest_rad)));
}

}  // namespace penumbra
