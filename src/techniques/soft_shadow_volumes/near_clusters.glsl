// SPDX-License-Identifier: Apache-2.0
// The clusters of triangles that may matter to a small tile, for groups of 64 that have prepared its shaft. Requires
// tile_shaft.glsl.

layout(std430) readonly buffer Bounds { TileBounds bounds[]; };
layout(std430) readonly buffer Clusters { TriangleCluster clusters[]; };
layout(std430) readonly buffer Triangles { LightTriangle triangles[]; };
layout(std430) readonly buffer Lists { uint lists[]; };

layout(std140) uniform Constants { ClusterConstants listed; };

shared uint near[clustersAtOnce];
shared uint nearCount;

// Lists those of the group's part of the large tile's list: `atOnce` of its clusters, at most clustersAtOnce.
void listNear(uint atOnce) {
    uint lane = gl_LocalInvocationIndex;
    if (lane == 0u) nearCount = 0u;
    barrier();
    uvec2 largeTile = gl_WorkGroupID.xy / volume.smallTilesALargeOne;
    uint list = (largeTile.y * volume.largeTilesAcross + largeTile.x) * ((listed.count + 31u) / 32u);
    uint part = gl_WorkGroupID.z * atOnce, end = min(part + atOnce, listed.count);
    for (uint cluster = part + lane; cluster < end; cluster += 64u) {
        bool isListed = (lists[list + cluster / 32u] & (1u << (cluster % 32u))) != 0u;
        if (isListed && meetsShaft(clusters[cluster].low.xyz, clusters[cluster].high.xyz))
            near[atomicAdd(nearCount, 1u)] = cluster;
    }
    barrier();
}
