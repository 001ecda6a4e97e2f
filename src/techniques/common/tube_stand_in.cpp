// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/common/tube_stand_in.h"

#include <bit>

#include "src/device/glm_types.h"
#include "src/techniques/common/light_constants.h"

namespace penumbra {
namespace {

glm::dvec3 middleOf(std::span<const Caster> casters, const glm::dvec3& otherwise) {
    glm::dvec3 low(otherwise), high(otherwise);
    bool isEmpty = true;
    for (const Caster& caster : casters) {
        const Box& box = caster.mesh->bounds();
        if (box.min.x > box.max.x) continue;
        const glm::dvec3 centerMesh = 0.5 * (glm::dvec3(toGlm(box.min)) + glm::dvec3(toGlm(box.max)));
        const glm::dvec3 extentMesh = 0.5 * (glm::dvec3(toGlm(box.max)) - glm::dvec3(toGlm(box.min)));
        const glm::dmat4 worldFromMesh = toGlm(caster.worldFromMesh);
        const glm::dvec3 center(worldFromMesh * glm::dvec4(centerMesh, 1));
        const glm::dmat3 turn(worldFromMesh);
        const glm::dvec3 extent = glm::abs(turn[0]) * extentMesh.x + glm::abs(turn[1]) * extentMesh.y +
                                  glm::abs(turn[2]) * extentMesh.z;
        low = isEmpty ? center - extent : glm::min(low, center - extent);
        high = isEmpty ? center + extent : glm::max(high, center + extent);
        isEmpty = false;
    }
    return 0.5 * (low + high);
}

}  // namespace

AreaLight lightFor(const Technique& technique, const ShadowInputs& inputs) {
    AreaLight light = inputs.light;
    if (light.shape != LightShape::cylinder) return light;
    if (!hasSize(light)) {
        light.shape = LightShape::sphere;
        return light;
    }
    if (technique.answersTubes()) return light;

    const glm::dmat4 worldFromLight = toGlm(light.worldFromLight);
    const glm::dvec3 axis(worldFromLight[0]), place(worldFromLight[3]);
    glm::dvec3 towards = middleOf(inputs.casters, place) - place;
    towards -= glm::dot(towards, axis) * axis;
    // Along its axis no way is better than another.
    constexpr double nearlyAlong = 1e-6;
    const glm::dvec3 z = glm::length(towards) > nearlyAlong * (glm::length(place) + double(light.length_m))
                             ? -glm::normalize(towards)
                             : glm::dvec3(worldFromLight[2]);
    const glm::dmat4 worldFromStrip(glm::dvec4(axis, 0), glm::dvec4(glm::cross(z, axis), 0), glm::dvec4(z, 0),
                                    worldFromLight[3]);
    light.shape = LightShape::rect;
    light.width_m = light.length_m;
    light.height_m = 2 * light.radius_m;
    light.twoSided = true;
    light.worldFromLight = std::bit_cast<Mat4>(glm::mat4(worldFromStrip));
    return light;
}

}  // namespace penumbra
