// SPDX-License-Identifier: Apache-2.0
#version 450
// For each large tile a list, as bits, of the clusters of triangles that may lie between its receivers and the light, or the
// light's centre.
layout(local_size_x = 64) in;

#include "src/techniques/soft_shadow_volumes/volumes_io.h"
#include "src/techniques/soft_shadow_volumes/tile_shaft.glsl"
#include "src/techniques/soft_shadow_volumes/large_tiles.glsl"

layout(std430) readonly buffer Clusters { TriangleCluster clusters[]; };
layout(std430) writeonly buffer Lists { uint lists[]; };

layout(std140) uniform Constants { ClusterConstants listed; };

void main() {
    TileBounds tile = largeTileBounds(ivec2(gl_WorkGroupID.xy));
    bool isEmpty = tile.low.x > tile.high.x;
    prepareShaft(tile, listed.toCenter ? centerBounds(tile) : lightBounds(tile));
    uint words = (listed.count + 31u) / 32u;
    uint list = (gl_WorkGroupID.y * volume.largeTilesAcross + gl_WorkGroupID.x) * words;
    for (uint word = gl_LocalInvocationIndex; word < words; word += 64u) {
        uint bits = 0u;
        uint count = isEmpty ? 0u : min(32u, listed.count - 32u * word);
        for (uint i = 0u; i < count; ++i) {
            TriangleCluster cluster = clusters[32u * word + i];
            if (meetsShaft(cluster.low.xyz, cluster.high.xyz)) bits |= 1u << i;
        }
        lists[list + word] = bits;
    }
}
