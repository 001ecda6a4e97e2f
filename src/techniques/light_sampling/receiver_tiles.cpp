// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/light_sampling/receiver_tiles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "src/techniques/light_sampling/subdivision.h"

namespace penumbra::light_sampling {
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
    : lookup_(device, {"src/techniques/light_sampling/receiver_tiles.comp.glsl"}),
      all_(mostTiles * sizeof(ReceiverTile), "all receivers of light samples"),
      unsettled_(mostTiles * sizeof(ReceiverTile), "unsettled receivers of light samples"),
      redraw_(sizeof(RedrawGroups), "whether receivers of light samples have moved") {}

void ReceiverTiles::findAll(const ShadowInputs& inputs, const ViewBinding& view, const SampleCameras& cameras,
                            SampleMaps& maps, const VisibilityBuffer& out) {
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
    const RedrawGroups none{{0, down_, 1, 0}, {0, 1, 1, 0}, {0, (out.height_px() + 7) / 8, 1, 0}};
    redraw_.write(std::as_bytes(std::span(&none, 1)));
    maps.choose(stageOfAll, 0);
    gl::Pass(lookup_.prepare(inputs.light, cameras, {}, {}))
        .constants(ReceiverTilesConstants{
            .size_px = {out.width_px(), out.height_px()}, .tile_px = tile_px_, .slots = maps.capacity()})
        .bind(view)
        .bind(maps)
        .bind(lookup_)
        .bind("Tiles", all_)
        .bind("RedrawBlock", redraw_)
        .dispatch(std::size_t(across_), std::size_t(down_));
}

void ReceiverTiles::findUnsettled(const ShadowInputs& inputs, const ViewBinding& view,
                                  const SampleCameras& cameras, SampleMaps& maps,
                                  const SubdivisionPasses& bits, const VisibilityBuffer& out, bool isKept) {
    maps.choose(stageOfAll, 0);
    gl::Pass pass(lookup_.prepare(inputs.light, cameras, {}, {.colored = out.colored(), .bits = true}));
    pass.constants(ReceiverTilesConstants{.tile_px = tile_px_, .lightRadius = float(radiusOf(inputs.light))})
        .bind(view)
        .bind(maps)
        .bind(lookup_)
        .bind(bits)
        .bind("Tiles", unsettled_);
    if (isKept) {
        pass.dispatchIndirect(redraw_, offsetof(RedrawGroups, tiles));
    } else {
        pass.dispatch(std::size_t(across_), std::size_t(down_));
    }
}

}  // namespace penumbra::light_sampling
