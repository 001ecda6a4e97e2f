// SPDX-License-Identifier: Apache-2.0
#version 450
// For each large tile a list of the edges that may matter there, as bits: as long for every tile, in the same order
// always, and never too short.
layout(local_size_x = 64) in;

#include "src/techniques/soft_shadow_volumes/volumes_io.h"
#include "src/techniques/soft_shadow_volumes/tile_shaft.glsl"
#include "src/techniques/soft_shadow_volumes/large_tiles.glsl"

layout(std430) readonly buffer LightEdges { LightEdge lightEdges[]; };
layout(std430) readonly buffer Eye { EyeState eye; };
layout(std430) readonly buffer WordBoxes { TriangleCluster wordBoxes[]; };  // see soft_boxes.comp.glsl
layout(std430) writeonly buffer Lists { uint lists[]; };

void main() {
    TileBounds tile = largeTileBounds(ivec2(gl_WorkGroupID.xy));
    bool isEmpty = tile.low.x > tile.high.x;
    prepareShaft(tile, lightBounds(tile));
    uint list = (gl_WorkGroupID.y * volume.largeTilesAcross + gl_WorkGroupID.x) * volume.listWords;
    // Each layer of groups takes a part of the list.
    uint part = gl_WorkGroupID.z * 512u;
    uint words = min(wordsOfEdges(eye.edgeCount), part + 512u);
    for (uint word = part + gl_LocalInvocationIndex; word < words; word += 64u) {
        uint bits = 0u;
        bool isNear = !isEmpty && meetsShaft(wordBoxes[word].low.xyz, wordBoxes[word].high.xyz);
        uint count = isNear ? min(32u, eye.edgeCount - 32u * word) : 0u;
        for (uint i = 0u; i < count; ++i) {
            if (mayMatter(lightEdges[32u * word + i])) bits |= 1u << i;
        }
        lists[list + word] = bits;
    }
}
