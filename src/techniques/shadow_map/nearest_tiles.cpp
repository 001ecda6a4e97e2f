// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/shadow_map/nearest_tiles.h"

#include <algorithm>

namespace penumbra {
namespace {

// As in nearest_tiles.glsl.
constexpr int tilesAcross = 64;
constexpr std::size_t tilesPerMap = 5461;

}  // namespace

NearestTiles::NearestTiles(Device& device)
    : tilesProgram_(device.internals().shaders, {"src/techniques/shadow_map/nearest_tiles.comp.glsl"}),
      levelsProgram_(device.internals().shaders, {"src/techniques/shadow_map/nearest_levels.comp.glsl"}) {}

void NearestTiles::build(const DepthMap& depthMap, LightShape shape) {
    const std::size_t maps = std::size_t(std::max(1, depthMap.count()));
    const std::size_t size_bytes = maps * tilesPerMap * sizeof(float);
    if (tiles_.name() == 0 || tiles_.size_bytes() < size_bytes)
        tiles_ = gl::Buffer(size_bytes, "nearest tiles");
    tile_px_ = (depthMap.texture().width_px() + tilesAcross - 1) / tilesAcross;
    if (depthMap.count() == 0) return;

    const GLuint layers = GLuint(depthMap.count());
    tilesProgram_.use();
    depthMap.bind(3, 0);
    bind(3);
    glUniform1i(0, tile_px_);
    glUniform1i(1, shape == LightShape::rect || shape == LightShape::disk);
    glDispatchCompute(tilesAcross, tilesAcross, layers);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    levelsProgram_.use();
    bind(3);
    glDispatchCompute(1, 1, layers);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace penumbra
