// SPDX-License-Identifier: Apache-2.0
#version 450
// Lists the blocks with edges, one invocation a block: nowhere else is there anything to do at the map's full
// resolution. An edge has more than a jump between two neighbours; whether their surfaces bend as well is asked later.
layout(local_size_x = 8, local_size_y = 8) in;

#define DEPTH_MAP_UNIT 3
#define DEPTH_MAP_BLOCK 0
#include "src/techniques/common/depth_map.glsl"
#include "src/techniques/shadow_width_map/edge_blocks.glsl"

layout(location = 0) uniform bool withInnerEdges;

void main() {
    int size_px = textureSize(depthMaps, 0).x;
    ivec3 block = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(8 * block.xy, ivec2(size_px)))) return;

    // The block and a texel around it, gathered where four texels meet: (x, y) of a quad are its upper row.
    float least = 1.0, most = 0.0;
    vec2 steps = vec2(0.0), below[5];
    for (int j = 0; j < 5; ++j) {
        vec2 left = vec2(0.0);
        for (int i = 0; i < 5; ++i) {
            vec4 quad = textureGather(depthMaps, vec3(vec2(8 * block.xy + 2 * ivec2(i, j)) / float(size_px), block.z));
            least = min(least, min(min(quad.x, quad.y), min(quad.z, quad.w)));
            most = max(most, max(max(quad.x, quad.y), max(quad.z, quad.w)));
            steps = max(steps, max(abs(quad.yz - quad.xw), abs(quad.xy - quad.wz)));
            if (i > 0) steps = max(steps, abs(quad.xw - left));
            if (j > 0) steps = max(steps, abs(quad.wz - below[i]));
            left = quad.yz;
            below[i] = quad.xy;
        }
    }
    bool isOutline = least == 0.0 && most > 0.0;
    bool isInner = withInnerEdges && most > 0.0 && max(steps.x, steps.y) > jumpBelow(block.z, least);
    if (isOutline || isInner)
        edgeBlocks[atomicAdd(blockCount, 1u)] = uint(block.x) | uint(block.y) << 10 | uint(block.z) << 20;
}
