// SPDX-License-Identifier: Apache-2.0
#version 450
// First half of an exact Euclidean distance transform (Meijster, Roerdink and Hesselink 2000): the nearest edge in each
// texel's column. One invocation a column, down and up again. Red: outlines of the casters' union, before nothing;
// green: inner edges, where a caster stands out against another.
layout(local_size_x = 16) in;

#define DEPTH_MAP_UNIT 3
#define DEPTH_MAP_BLOCK 0
#include "src/techniques/common/depth_map.glsl"
#include "src/techniques/shadow_width_map/nearest_edge.glsl"

layout(binding = 0, rg16ui) uniform uimage2DArray columns;
layout(location = 0) uniform bool withInnerEdges;

// Stored depth is an affine function over any plane, in both projections (perspective: near / z). So a surface that
// goes on across a texel's side has no second difference; what exceeds this many texels of depth is an edge. A crease
// of two slopes differs by the slopes' difference in texels: a roof of two planes of 60 degrees by 3.5.
const float jumpTexels = 4.0;

float stored(ivec3 texel, int size_px) {
    return texelFetch(depthMaps, ivec3(clamp(texel.xy, ivec2(0), ivec2(size_px - 1)), texel.z), 0).r;
}

void main() {
    int size_px = textureSize(depthMaps, 0).x;
    ivec3 texel = ivec3(gl_GlobalInvocationID.x, 0, gl_GlobalInvocationID.y);
    if (texel.x >= size_px) return;
    vec4 depth = lightCameras[texel.z].depth;
    bool orthographic = depth.z == 1.0;
    float tolerance = jumpTexels * depth.w;

    uvec2 nearest = uvec2(0u);
    float above = stored(texel, size_px), here = above;
    for (int row = 0; row < size_px; ++row) {
        texel.y = row;
        float below = stored(texel + ivec3(0, 1, 0), size_px);
        if (here > 0.0) {
            vec4 around = vec4(stored(texel + ivec3(1, 0, 0), size_px), stored(texel - ivec3(1, 0, 0), size_px), below, above);
            float least = min(min(around.x, around.y), min(around.z, around.w));
            if (least == 0.0) {
                uvec4 sides = mix(uvec4(0u), uvec4(1u, 2u, 4u, 8u), equal(around, vec4(0.0)));
                nearest.x = packInColumn(row, sides.x | sides.y | sides.z | sides.w);
            }
            float jump = orthographic ? tolerance / (depth.y - depth.x) : tolerance * here;
            if (withInnerEdges && here - least > jump) {
                uint sides = 0u;
                for (int direction = 0; direction < 4; ++direction) {
                    float there = around[direction];
                    if (there == 0.0 || here - there <= jump) continue;
                    float before = around[direction ^ 1];
                    float beyond = stored(texel + 2 * ivec3(edgeDirections[direction], 0), size_px);
                    float bend = min(2.0 * here - before - there, here + beyond - 2.0 * there);
                    if (bend > jump) sides |= 1u << direction;
                }
                if (sides != 0u) nearest.y = packInColumn(row, sides);
            }
        }
        imageStore(columns, texel, uvec4(nearest, 0u, 0u));
        above = here;
        here = below;
    }
    for (int row = size_px - 2; row >= 0; --row) {
        texel.y = row;
        uvec2 own = imageLoad(columns, texel).rg;
        for (int kind = 0; kind < 2; ++kind) {
            if (!isEdgeInColumn(own[kind])) continue;
            bool isNearer = row - rowInColumn(own[kind]) <= abs(rowInColumn(nearest[kind]) - row);
            if (isNearer || !isEdgeInColumn(nearest[kind])) nearest[kind] = own[kind];
        }
        if (nearest != own) imageStore(columns, texel, uvec4(nearest, 0u, 0u));
    }
}
