// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/light_sampling/receiver_tiles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace penumbra {
namespace {

/// No part of the light is farther from its centre, or from a distant light's axis as a sine.
double radiusOf(const AreaLight& light) {
    switch (light.shape) {
        case LightShape::rect:
            return 0.5 * std::hypot(light.width_m, light.height_m);
        case LightShape::distant:
            return std::sin(std::min(0.5 * light.angle_rad, 0.5 * std::numbers::pi));
        default:
            return light.radius_m;
    }
}

}  // namespace

ReceiverTiles::ReceiverTiles(Device& device)
    : lookup_(device, "src/techniques/light_sampling/receiver_tiles.comp.glsl"),
      all_(mostTiles * sizeof(ReceiverTile), "all receivers of light samples"),
      unsettled_(mostTiles * sizeof(ReceiverTile), "unsettled receivers of light samples"),
      redraw_(sizeof(RedrawGroups), "whether receivers of light samples have moved") {}

void ReceiverTiles::findAll(const ShadowInputs& inputs, const SampleCameras& cameras, const SampleMaps& maps,
                            const VisibilityBuffer& out) {
    // Each tile is looked at for each map: it costs about what 64 triangles do (llvmpipe), and the finer
    // tiles are, the fewer triangles are drawn. The smallest has a pixel for each of 8 x 8 invocations.
    std::size_t indices = 0;
    for (const Caster& caster : inputs.casters) indices += caster.casts ? caster.mesh->indices().size() : 0;
    const int enough = int(std::clamp<std::size_t>(indices / 3 / 64, 256, mostTiles));
    for (tile_px_ = 8;; tile_px_ *= 2) {
        across_ = (out.width_px() + tile_px_ - 1) / tile_px_;
        down_ = (out.height_px() + tile_px_ - 1) / tile_px_;
        if (count() <= enough) break;
    }
    const RedrawGroups none{{0, down_, 1, 0}, {0, 1, 1, 0}};
    redraw_.write(std::as_bytes(std::span(&none, 1)));
    lookup_.use(inputs.light, cameras, {}, {});
    bind(all_, maps);
    glUniform1i(17, maps.capacity());
    glDispatchCompute(GLuint(across_), GLuint(down_), 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void ReceiverTiles::findUnsettled(const ShadowInputs& inputs, const SampleCameras& cameras,
                                  const SampleMaps& maps, const VisibilityBuffer& out, bool isKept) {
    lookup_.use(inputs.light, cameras, {}, {.colored = out.colored(), .bits = true});
    bind(unsettled_, maps);
    glUniform1f(17, float(radiusOf(inputs.light)));
    if (isKept) {
        gl::dispatchIndirect(redraw_, offsetof(RedrawGroups, tiles));
    } else {
        glDispatchCompute(GLuint(across_), GLuint(down_), 1);
    }
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void ReceiverTiles::bind(const gl::Buffer& tiles, const SampleMaps& maps) {
    maps.bind();
    maps.setBatch(stageOfAll, 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, tiles.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 6, redraw_.name());
    glUniform1i(16, tile_px_);
}

}  // namespace penumbra
