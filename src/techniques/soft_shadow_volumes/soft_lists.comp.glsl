// SPDX-License-Identifier: Apache-2.0
#version 450
// For each large tile a list of the edges that may matter there, as bits: as long for every tile, in the same order
// always, and never too short.
layout(local_size_x = 64) in;

#include "src/techniques/soft_shadow_volumes/volumes_io.h"
#include "src/techniques/soft_shadow_volumes/tile_shaft.glsl"

layout(std430, binding = 0) readonly buffer Bounds { TileBounds bounds[]; };
layout(std430, binding = 1) readonly buffer LightEdges { LightEdge lightEdges[]; };
layout(std430, binding = 2) readonly buffer Eye { EyeState eye; };
layout(std430, binding = 3) writeonly buffer Lists { uint lists[]; };

shared TileBounds parts[64];

// Around all receivers of the small tiles from `first` to before `end`.
TileBounds boundsOf(ivec2 first, ivec2 end) {
    uint lane = gl_LocalInvocationIndex;
    const TileBounds none = TileBounds(vec4(3e38), vec4(-3e38));
    TileBounds part = none;
    int width = end.x - first.x, count = width * (end.y - first.y);
    for (int i = int(lane); i < count; i += 64) {
        TileBounds small = bounds[(first.y + i / width) * volume.tiles.x + first.x + i % width];
        if (small.low.x > small.high.x) continue;
        part.low = min(part.low, small.low);
        part.high = max(part.high, small.high);
    }
    parts[lane] = part;
    barrier();
    TileBounds tile = none;
    for (int i = 0; i < min(64, count); ++i) {
        tile.low = min(tile.low, parts[i].low);
        tile.high = max(tile.high, parts[i].high);
    }
    return tile;
}

void main() {
    ivec2 smallTiles = (volume.buffer_px.xy + 7) / 8;
    ivec2 first = ivec2(gl_WorkGroupID.xy) * volume.tiles.z;
    TileBounds tile = boundsOf(first, min(first + volume.tiles.z, smallTiles));
    bool isEmpty = tile.low.x > tile.high.x;
    prepareShaft(tile);
    uint list = (gl_WorkGroupID.y * uint(volume.tiles.y) + gl_WorkGroupID.x) * uint(volume.tiles.w);
    // Each layer of groups takes a part of the list.
    uint part = gl_WorkGroupID.z * 512u;
    uint words = min(wordsOfEdges(eye.edgeCount), part + 512u);
    for (uint word = part + gl_LocalInvocationIndex; word < words; word += 64u) {
        uint bits = 0u;
        uint count = isEmpty ? 0u : min(32u, eye.edgeCount - 32u * word);
        for (uint i = 0u; i < count; ++i) {
            if (mayMatter(lightEdges[32u * word + i])) bits |= 1u << i;
        }
        lists[list + word] = bits;
    }
}
