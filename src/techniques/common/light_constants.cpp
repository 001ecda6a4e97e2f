// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/common/light_constants.h"

#include <algorithm>
#include <cmath>

#include "penumbra/light_plane.h"

namespace penumbra {

glm::dvec2 lightExtent(const AreaLight& light) {
    switch (light.shape) {
        case LightShape::rect:
            return 0.5 * glm::dvec2(light.width_m, light.height_m);
        case LightShape::disk:
        case LightShape::sphere:
            return glm::dvec2(light.radius_m);
        case LightShape::cylinder:
            return {0.5 * double(light.length_m), light.radius_m};
        case LightShape::distant:
            break;
    }
    constexpr double widest_rad = 1.52;
    return glm::dvec2(std::tan(std::min(0.5 * double(light.angle_rad), widest_rad)));
}

bool hasSize(const AreaLight& light) {
    return lightExtent(light) != glm::dvec2(0);
}

bool isOneSided(const AreaLight& light) {
    return (light.shape == LightShape::rect || light.shape == LightShape::disk) && !light.twoSided;
}

LightConstants lightConstants(const AreaLight& light) {
    static_assert(int(LightShape::rect) == shapeRect && int(LightShape::disk) == shapeDisk &&
                  int(LightShape::sphere) == shapeSphere && int(LightShape::distant) == shapeDistant &&
                  int(LightShape::cylinder) == shapeCylinder);
    return {.halfSize = lightExtent(light),
            .shape = int(light.shape),
            .isOneSided = isOneSided(light),
            .hasSize = hasSize(light),
            .isTextured = light.radianceTexture != 0,
            .planeTolerance = lightPlaneTolerance};
}

}  // namespace penumbra
