// SPDX-License-Identifier: Apache-2.0
#version 450
// The farthest surface that the light sees in each tile of its window, by every fourth texel: it bounds how wide the
// smoothies thereabouts can become.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/smoothies/smoothies.glsl"
#include "src/techniques/smoothies/surfaces.glsl"
#include "src/techniques/smoothies/smoothie_edges_io.h"

layout(std430) writeonly buffer Tiles { float farthestNearness[]; };

// A tile an invocation: barriers cost software rasterisers more than the texels do.
void main() {
    int size_px = textureSize(depthMaps, 0).x;
    int camera = int(gl_GlobalInvocationID.z);
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    ivec2 begin = tile * size_px / tilesAcross, end = (tile + 1) * size_px / tilesAcross;
    float nearness = smoothies[camera].nearestDrawn;
    for (int y = begin.y; y < end.y; y += 4) {
        for (int x = begin.x; x < end.x; x += 4) {
            ivec2 texel = ivec2(x, y);
            nearness = min(nearness, max(blockerNearness(camera, camera, texel), receiverNearness(camera, camera, texel)));
        }
    }
    farthestNearness[(camera * tilesAcross + tile.y) * tilesAcross + tile.x] = nearness;
}
