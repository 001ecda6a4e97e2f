// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/exact_visibility/receiver_tiles.h"

#include "src/gl/pass.h"

namespace penumbra::exact_visibility {

ReceiverTiles::ReceiverTiles(gl::ShaderLibrary& shaders)
    : look_(shaders, {"src/techniques/exact_visibility/receiver_tiles.comp.glsl"}) {}

void ReceiverTiles::look(const View& view, const ViewBinding& binding,
                         const gl::ConstantBuffer<ExactFrame>& frame, const glm::dvec3& originWorld,
                         const ReceiverWatch& watch, std::uint32_t changed) {
    const auto tilesAlong = [](int size_px) { return std::size_t(size_px + EXACT_TILE - 1) / EXACT_TILE; };
    const std::size_t tiles = tilesAlong(view.width_px) * tilesAlong(view.height_px);
    constexpr std::size_t groupTiles = 32;
    bounds_.reserve(tiles * sizeof(TileBounds), "exact/bounds of tiles");
    const bool othersStay = changed_ != 0 && originWorld_ == originWorld;
    gl::Pass(look_)
        .constants(ExactLook{.serial = othersStay ? changed : 0})
        .bind(binding)
        .bind("FrameBlock", frame)
        .bind("TileRevisions", watch.tileRevisions())
        .bind("Tiles", bounds_)
        .dispatch((tiles + groupTiles - 1) / groupTiles);
    originWorld_ = originWorld;
    changed_ = changed;
}

}  // namespace penumbra::exact_visibility
