// SPDX-License-Identifier: Apache-2.0
#version 450
// The pyramid's upper levels: one work group a map.
layout(local_size_x = 16, local_size_y = 16) in;

#include "src/techniques/shadow_map/nearest_tiles.glsl"

layout(std430) coherent buffer NearestTiles { float nearestTiles[][tangents]; };

void main() {
    int map = int(gl_WorkGroupID.z) * tilesPerMap;
    for (int level = 1; level < pyramidLevels; ++level) {
        int across = tilesAcross >> level;
        int below = map + pyramidStart(level - 1);
        for (int i = int(gl_LocalInvocationIndex); i < across * across; i += 256) {
            ivec2 tile = 2 * ivec2(i % across, i / across);
            int first = below + tile.y * 2 * across + tile.x;
            for (int tangent = 0; tangent < tangents; ++tangent) {
                nearestTiles[map + pyramidStart(level) + i][tangent] =
                    max(max(nearestTiles[first][tangent], nearestTiles[first + 1][tangent]),
                        max(nearestTiles[first + 2 * across][tangent], nearestTiles[first + 2 * across + 1][tangent]));
            }
        }
        memoryBarrierBuffer();
        barrier();
    }
}
