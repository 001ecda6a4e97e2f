// SPDX-License-Identifier: Apache-2.0
#include "studio/frame/lighting_constants.h"

#include <algorithm>
#include <cmath>

#include "penumbra/light_plane.h"
#include "studio/scene/profiles/light_profile.h"
#include "studio/scene/profiles/luminaire.h"

namespace penumbra::studio {
namespace {

static_assert(int(LightShape::rect) == shapeRect && int(LightShape::disk) == shapeDisk &&
              int(LightShape::sphere) == shapeSphere && int(LightShape::distant) == shapeDistant &&
              int(LightShape::cylinder) == shapeCylinder);

bool hasSize(const AreaLight& shape) {
    switch (shape.shape) {
        case LightShape::rect:
            return shape.width_m > 0 && shape.height_m > 0;
        case LightShape::disk:
        case LightShape::sphere:
            return shape.radius_m > 0;
        case LightShape::distant:
            return shape.angle_rad > 0;
        case LightShape::cylinder:
            return shape.length_m > 0 && shape.radius_m > 0;
    }
    return false;
}

ProfileConstants profileConstants(const Light& light) {
    if (!light.profile) return {};
    const CandelaGrid& grid = light.profile->profile->grid;
    using Type = CandelaGrid::Type;
    return {
        .towardsC0 = towardsC0(*light.profile),
        .type = grid.type == Type::A   ? profileTypeA
                : grid.type == Type::B ? profileTypeB
                                       : profileTypeC,
        .towardsZenith = towardsZenith(*light.profile),
        .firstPlane_rad = float(glm::radians(grid.firstPlane_deg)),
        .verticals = int(grid.verticals_deg.size()),
        .horizontals = int(grid.horizontals_deg.size()),
        .angleScale = light.profile->angleScale,
        .factor = light.profile->factor * light.profile->tilt,
        .isMirrored = grid.horizontals_deg.front() == 0,
        .isLuminaire = light.profile->isLuminaire,
        .pointsPerDistance = std::max(leastPointsPerDistance, float(1 / widestPart_rad(*light.profile))),
    };
}

}  // namespace

LightingConstants lightingConstants(const Light& light, const glm::dmat4& worldFromLight) {
    const AreaLight& shape = light.shape;
    const glm::vec2 cone = light.cone_rad
                               ? glm::vec2(std::cos((*light.cone_rad)[0]), std::cos((*light.cone_rad)[1]))
                               : glm::vec2(-2);
    return {
        .lightFromWorld = glm::inverse(worldFromLight),
        .emission = light.emission.value,
        .halfAngle_rad = 0.5f * shape.angle_rad,
        .halfSize_m = shape.shape == LightShape::cylinder ? glm::vec2(0.5f * shape.length_m)
                                                          : 0.5f * glm::vec2(shape.width_m, shape.height_m),
        .coneCosines = cone,
        .radius_m = shape.radius_m,
        .shape = int(shape.shape),
        .isTwoSided = shape.twoSided,
        .isPoint = light.emission.unit != Emission::Unit::nits && !hasSize(shape),
        .isTextured = light.texture >= 0,
        .planeTolerance = lightPlaneTolerance,
        .profile = profileConstants(light),
    };
}

}  // namespace penumbra::studio
