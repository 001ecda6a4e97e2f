// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "penumbra/light.h"
#include "src/gl/buffer.h"
#include "src/gl/program.h"
#include "src/techniques/common/depth_map.h"

namespace penumbra::shadow_map {

/// How near to the light the nearest blocker may be in any part of a depth map: see nearest_tiles.glsl.
class NearestTiles {
  public:
    explicit NearestTiles(Device& device);

    void build(const DepthMap& depthMap, const AreaLight& light);
    const gl::Buffer& tiles() const { return tiles_; }

    /// Width of a tile.
    int tile_px() const { return tile_px_; }

  private:
    gl::Program tilesProgram_, levelsProgram_;
    gl::Buffer tiles_;
    int tile_px_ = 1;
};

}  // namespace penumbra::shadow_map
