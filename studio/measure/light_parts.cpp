// SPDX-License-Identifier: Apache-2.0
#include "studio/measure/light_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "studio/frame/conversions.h"
#include "studio/scene/profiles/luminaire.h"

namespace penumbra::studio {
namespace {

constexpr int mostPartsAlong = 8;

/// From a rectangle, in metres.
double distanceOf(const glm::dvec3& posLight, const glm::dvec2& halfSize_m) {
    return glm::length(glm::dvec3(glm::max(glm::abs(glm::dvec2(posLight)) - halfSize_m, 0.0), posLight.z));
}

}  // namespace

glm::ivec2 partsWanted(const Light& light, const std::vector<MeasuringPoint>& points) {
    const AreaLight& shape = light.shape;
    if (!light.profile || shape.shape != LightShape::rect || shape.width_m <= 0 || shape.height_m <= 0)
        return {1, 1};
    const glm::dmat4 worldFromLight(fromPenumbra(shape.worldFromLight));
    const glm::dmat4 lightFromWorld = glm::inverse(worldFromLight);
    const glm::dvec2 size_m(shape.width_m, shape.height_m);
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const MeasuringPoint& point : points) {
        const glm::dvec3 posLight(lightFromWorld * glm::dvec4(point.posWorld, 1));
        nearest_m = std::min(nearest_m, distanceOf(posLight, 0.5 * size_m));
    }
    const double widest_rad = widestPart_rad(*light.profile);
    const glm::dvec2 wanted = size_m / std::max(nearest_m * widest_rad, 1e-9);
    return {std::clamp(int(std::ceil(std::min(wanted.x, 1e6))), 1, mostPartsAlong),
            std::clamp(int(std::ceil(std::min(wanted.y, 1e6))), 1, mostPartsAlong)};
}

std::vector<Light> partsOf(const Light& light, const glm::ivec2& counts) {
    if (counts == glm::ivec2(1)) return {light};
    const AreaLight& shape = light.shape;
    const glm::dmat4 worldFromLight(fromPenumbra(shape.worldFromLight));
    const glm::dvec2 size_m(shape.width_m, shape.height_m);
    std::vector<Light> parts;
    for (int y = 0; y < counts.y; ++y) {
        for (int x = 0; x < counts.x; ++x) {
            Light& part = parts.emplace_back(light);
            const glm::dvec2 middle = ((glm::dvec2(x, y) + 0.5) / glm::dvec2(counts) - 0.5) * size_m;
            glm::dmat4 worldFromPart = worldFromLight;
            worldFromPart[3] = worldFromLight * glm::dvec4(middle, 0, 1);
            part.shape.worldFromLight = toPenumbra(glm::mat4(worldFromPart));
            part.shape.width_m = shape.width_m / float(counts.x);
            part.shape.height_m = shape.height_m / float(counts.y);
            // A luminaire's candela are the whole one's.
            if (light.profile->isLuminaire) part.emission.value /= float(counts.x * counts.y);
        }
    }
    return parts;
}

}  // namespace penumbra::studio
