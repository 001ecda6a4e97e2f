// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/common/view_constants.h"

#include "src/device/glm_types.h"
#include "src/device/visibility_internals.h"

namespace penumbra {
glm::dmat4 lightFromWorld(const ShadowInputs& inputs) {
    glm::dmat4 worldFromLight = toGlm(inputs.light.worldFromLight);
    if (inputs.light.shape == LightShape::distant) {
        glm::dvec3 sum(0);
        double count = 0;
        for (const Caster& caster : inputs.casters) {
            const Box& box = caster.mesh->bounds();
            if (box.min.x > box.max.x) continue;
            const glm::dvec3 centerMesh = 0.5 * (glm::dvec3(toGlm(box.min)) + glm::dvec3(toGlm(box.max)));
            sum += glm::dvec3(toGlm(caster.worldFromMesh) * glm::dvec4(centerMesh, 1));
            ++count;
        }
        worldFromLight[3] = {count > 0 ? sum / count : sum, 1};
    }
    return glm::inverse(worldFromLight);
}

void ViewBinding::fill(const View& view, const glm::dmat4& lightFromWorldMatrix) {
    const bool zeroToOne = view.depth.range == DepthConvention::Range::zeroToOne;
    const glm::dmat4 clipFromWorld = toGlm(view.clipFromView) * toGlm(view.viewFromWorld);
    // Nearness is depth, or what it lacks to 1; clip-space z is depth as it is, or from -1.
    const float depthScale = view.depth.reversed ? 1 : -1, depthOffset = view.depth.reversed ? 0 : 1;
    const float zScale = zeroToOne ? 1 : 2, zOffset = zeroToOne ? 0 : -1;
    glm::dmat4 clipFromPicture(1);
    clipFromPicture[2][2] = zScale * depthScale;
    clipFromPicture[3][2] = zScale * depthOffset + zOffset;
    // Points lie where they say, whatever their depth.
    if (view.isOfPoints) clipFromPicture[2] = glm::dvec4(0);
    constants_.write({
        .lightFromPicture = lightFromWorldMatrix * glm::inverse(clipFromWorld) * clipFromPicture,
        .lightFromWorld = lightFromWorldMatrix,
        .nearnessScale = depthScale,
        .nearnessOffset = depthOffset,
        .backgroundDepth = view.depth.reversed ? 0.0f : 1.0f,
        .hasNormals = view.normalTexture != 0,
        .size_px = {view.width_px, view.height_px},
        .hasReceiverMask = view.receiverTexture != 0,
        .isOfPoints = view.isOfPoints,
    });
    depth_ = view.depthTexture;
    normals_ = view.normalTexture;
    receivers_ = view.receiverTexture;
}

void ViewBinding::bindTo(gl::Pass& pass) const {
    pass.bind("ViewBlock", constants_)
        .bind("viewDepth", gl::TextureRef{.name = depth_})
        .bind("viewNormals", gl::TextureRef{.name = normals_})
        .bind("viewReceivers", gl::TextureRef{.name = receivers_});
}

gl::TextureRef imageOf(const VisibilityBuffer& out) {
    VisibilityBuffer::Internals& internals = internalsOf(out);
    return {.name = out.texture(),
            .format = out.colored() ? gl::Format::rgba16f : gl::Format::r32f,
            .isLayered = false,
            .record = &internals.written};
}

std::vector<PassTime> passTimes(const gl::PassTimers& timers) {
    std::vector<PassTime> times;
    for (const auto& [name, milliseconds] : timers.latest()) times.push_back({name, milliseconds});
    return times;
}

}  // namespace penumbra
