// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/exact_visibility/light_description.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>

#include "penumbra/light_plane.h"
#include "src/device/glm_types.h"
#include "src/techniques/common/light_constants.h"

namespace penumbra::exact_visibility {

ExactFrame describeFrame(const View& view, const glm::dvec3& originWorld, int tileCapacity) {
    const glm::dmat4 worldFromView = glm::inverse(toGlm(view.viewFromWorld));
    const glm::dmat4 clipFromWorld = toGlm(view.clipFromView) * toGlm(view.viewFromWorld);
    const glm::dvec4 share = glm::row(clipFromWorld, 3);
    return {
        .eye = glm::dvec3(worldFromView[3]) - originWorld,
        .tilesAcross = (view.width_px + EXACT_TILE - 1) / EXACT_TILE,
        .sight = glm::dvec3(share),
        .sightOffset = float(share.w + glm::dot(glm::dvec3(share), originWorld)),
        .tileCapacity = tileCapacity,
    };
}

ExactLight describeLight(const AreaLight& light, const glm::dvec3& originWorld,
                         std::span<const LightLattice> lattices, bool isWeightedByIrradiance, int nodeCount) {
    const glm::dmat4 worldFromLight = toGlm(light.worldFromLight);
    const glm::dmat3 axes(worldFromLight);
    const bool isDistant = light.shape == LightShape::distant, isSphere = light.shape == LightShape::sphere;
    const bool isTube = light.shape == LightShape::cylinder;
    const double halfAngle = 0.5 * double(light.angle_rad);
    const auto coneCosine = float(std::cos(halfAngle));
    const glm::dvec3 center = isDistant ? glm::dvec3(0) : glm::dvec3(worldFromLight[3]) - originWorld;
    const glm::dvec2 size = lightExtent(light);
    glm::dvec3 low, high;
    for (int i = 0; i < 3; ++i) {
        if (isDistant) {
            // The cone's directions make angles with the axis that run from one to the other.
            const double angle = std::acos(std::clamp(axes[2][i], -1.0, 1.0));
            low[i] = std::cos(std::min(angle + halfAngle, std::acos(-1.0))) - 1e-6;
            high[i] = std::cos(std::max(angle - halfAngle, 0.0)) + 1e-6;
        } else {
            const double across = isTube ? std::hypot(axes[1][i], axes[2][i]) : std::abs(axes[1][i]);
            const double reach = isSphere ? light.radius_m : std::abs(axes[0][i]) * size.x + across * size.y;
            const double pad = 1e-6 * (std::abs(center[i]) + reach);
            low[i] = center[i] - reach - pad;
            high[i] = center[i] + reach + pad;
        }
    }

    const glm::dmat2 lattice = lattices.front().latticeFromUv, inverse = glm::inverse(lattice);
    ExactLight result{
        .emitter = lightConstants(light),
        .center = center,
        .coneCosine = coneCosine,
        .axisX = axes[0],
        .isWeightedByIrradiance = isWeightedByIrradiance,
        .axisY = axes[1],
        .latticeCount = int(lattices.size()),
        .axisZ = axes[2],
        .planeTolerance = lightPlaneTolerance,
        .boxMin = low,
        .coneSine = std::sqrt(std::max(1 - coneCosine * coneCosine, 0.0f)),
        .boxMax = high,
        .nodeCount = nodeCount,
        .latticeFromU = lattice[0],
        .latticeFromV = lattice[1],
        .uvFromI = inverse[0],
        .uvFromJ = inverse[1],
    };
    for (std::size_t i = 0; i < lattices.size(); ++i) {
        result.offsets[i] = glm::vec4(lattices[i].offset, 0, 0);
        for (std::size_t j = 0; j < lattices[i].validRows.size(); ++j) {
            const std::size_t row = i * EXACT_MAX_ROWS + j;
            result.valid[row / 4][int(row % 4)] = lattices[i].validRows[j];
        }
    }
    return result;
}

float standInShift(const AreaLight& light, std::span<const LightLattice> lattices,
                   bool isWeightedByIrradiance) {
    if (light.radianceTexture != 0 || isWeightedByIrradiance) return 0;
    // Along the light's smaller side, whichever way the edge lies.
    const glm::dvec2 extent = lightExtent(light);
    double size = std::min(extent.x, extent.y);
    constexpr double widestTangent = 1;  // beyond 45 degrees an angle's tangent grows faster than it does
    if (light.shape == LightShape::distant) size = std::min(size, widestTangent);
    const double spacing = glm::length(glm::inverse(lattices.front().latticeFromUv)[0]);
    return float(EXACT_STAND_IN_SHIFT * size * spacing / std::sqrt(double(lattices.size())));
}

}  // namespace penumbra::exact_visibility
