// SPDX-License-Identifier: Apache-2.0
#version 450
// From a smaller V-buffer to the picture, where that is easy: if all texels that any pixel of a tile may take from are
// equal, it does not matter which they are. The other tiles are listed for upsample.comp.glsl.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/common/view.glsl"
#include "src/techniques/soft_shadow_volumes/volumes_io.h"

// DispatchIndirectCommand, then the tiles.
layout(std430) buffer MixedTiles { uint mixedTiles[]; };
uniform sampler2D vBuffer;
uniform writeonly image2D visibility;

shared vec3 around[64];
shared uint differences;

layout(std140) uniform Constants { UpsampleConstants how; };

void main() {
    int scale = volume.pixelsPerTexel;
    int lane = int(gl_LocalInvocationIndex);
    // A pixel takes from one texel before its own to two after.
    int width = 8 / scale + 3;
    ivec2 texel = ivec2(gl_WorkGroupID.xy) * 8 / scale - 1 + ivec2(lane % width, lane / width);
    around[lane] = texelFetch(vBuffer, clamp(texel, ivec2(0), volume.buffer_px - 1), 0).rgb;
    if (lane == 0) differences = 0u;
    barrier();
    if (lane < width * width && around[lane] != around[0]) differences = 1u;
    barrier();
    if (lane == 0 && differences != 0u && !how.byPoint) {
        mixedTiles[3u + atomicAdd(mixedTiles[0], 1u)] = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    }
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, view.size_px))) return;
    // As published, a pixel takes from the texel it lies in, whatever that shows (figure 19).
    vec3 seen = how.byPoint ? texelFetch(vBuffer, pixel / scale, 0).rgb : around[0];
    imageStore(visibility, pixel, vec4(isReceiver(pixel) ? seen : vec3(1.0), 1.0));
}
