// SPDX-License-Identifier: Apache-2.0
#version 450
// Which tiles have a receiver that is not what it was at the last look: bit by bit, so that what is kept is what would
// come out anew.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/common/view.glsl"
#include "src/techniques/exact_visibility/exact_io.h"

layout(std140) uniform Constants { ExactLook look; };
layout(std430) buffer SeenReceivers { uint seen[]; };  // look.words a pixel
layout(std430) writeonly buffer TileRevisions { uint tileRevisions[]; };

// How far away pixels are whose depths tell a normal (view.glsl).
const int reach_px = 2;

bool differs = false;

void compare(inout uint place, uint value) {
    if (seen[place] != value) {
        seen[place] = value;
        differs = true;
    }
    ++place;
}

void compare(inout uint place, vec3 value) {
    for (int i = 0; i < 3; ++i) compare(place, floatBitsToUint(value[i]));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, view.size_px))) return;
    uint place = uint(pixel.y * view.size_px.x + pixel.x) * look.words;
    vec4 stored = texelFetch(viewDepth, pixel, 0);
    compare(place, floatBitsToUint(stored.r));
    if (view.isOfPoints) compare(place, stored.gba);
    if (view.hasNormals) compare(place, texelFetch(viewNormals, pixel, 0).rgb);
    if (view.hasReceiverMask) compare(place, texelFetch(viewReceivers, pixel, 0).r >= 0.5 ? 1u : 0u);
    if (!differs) return;
    ivec2 tiles = (view.size_px + EXACT_TILE - 1) / EXACT_TILE;
    ivec2 low = max(pixel - reach_px, ivec2(0)) / EXACT_TILE, high = min(pixel + reach_px, view.size_px - 1) / EXACT_TILE;
    for (int y = low.y; y <= high.y; ++y) {
        for (int x = low.x; x <= high.x; ++x) tileRevisions[y * tiles.x + x] = look.serial;
    }
}
