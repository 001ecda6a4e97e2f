// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/shadow_map/nearest_tiles.h"

#include <algorithm>

#include "src/techniques/common/light_constants.h"
#include "src/techniques/shadow_map/shadow_map_io.h"

namespace penumbra::shadow_map {
namespace {

// As in nearest_tiles.glsl.
constexpr int tilesAcross = 64;
constexpr std::size_t tilesPerMap = 5461;
constexpr std::size_t tangents = 8;

}  // namespace

NearestTiles::NearestTiles(Device& device)
    : tilesProgram_(internalsOf(device).shaders, {"src/techniques/shadow_map/nearest_tiles.comp.glsl"}),
      levelsProgram_(internalsOf(device).shaders, {"src/techniques/shadow_map/nearest_levels.comp.glsl"}) {}

void NearestTiles::build(const DepthMap& depthMap, const AreaLight& light) {
    const std::size_t maps = std::size_t(std::max(1, depthMap.count()));
    tiles_.reserve(maps * tilesPerMap * tangents * sizeof(float), "nearest tiles");
    tile_px_ = (depthMap.texture().width_px() + tilesAcross - 1) / tilesAcross;
    if (depthMap.count() == 0) return;

    const auto layers = std::size_t(depthMap.count());
    gl::Pass(tilesProgram_)
        .constants(NearestTilesConstants{.light = lightConstants(light), .tile_px = tile_px_})
        .bind(depthMap)
        .bind("NearestTiles", tiles_)
        .dispatch(tilesAcross, tilesAcross, layers);
    gl::Pass(levelsProgram_).bind("NearestTiles", tiles_).dispatch(1, 1, layers);
}

}  // namespace penumbra::shadow_map
