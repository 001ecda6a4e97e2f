// SPDX-License-Identifier: Apache-2.0
#version 450
// Lists the blocks with edges, one invocation a block: nowhere else is there anything to do at the map's full
// resolution. An edge has more than a jump between two neighbours; whether their surfaces bend as well is asked later.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/common/depth_map.glsl"
#include "src/techniques/shadow_width_map/edge_blocks.glsl"
#include "src/techniques/shadow_width_map/shadow_width_io.h"

layout(std140) uniform Constants { EdgeConstants edges; };
uniform sampler2DArray farthestMaps;

struct Steps {
    float least, most;  // stored depths
    float greatest;     // difference between two neighbours
};

// In the block and a texel around it, gathered where four texels meet: (x, y) of a quad are its upper row.
Steps stepsIn(sampler2DArray maps, ivec3 block, float size_px) {
    Steps steps = Steps(1.0, 0.0, 0.0);
    vec2 below[5];
    for (int j = 0; j < 5; ++j) {
        vec2 left = vec2(0.0);
        for (int i = 0; i < 5; ++i) {
            vec4 quad = textureGather(maps, vec3(vec2(8 * block.xy + 2 * ivec2(i, j)) / size_px, block.z));
            steps.least = min(steps.least, min(min(quad.x, quad.y), min(quad.z, quad.w)));
            steps.most = max(steps.most, max(max(quad.x, quad.y), max(quad.z, quad.w)));
            vec2 step = max(abs(quad.yz - quad.xw), abs(quad.xy - quad.wz));
            if (i > 0) step = max(step, abs(quad.xw - left));
            if (j > 0) step = max(step, abs(quad.wz - below[i]));
            steps.greatest = max(steps.greatest, max(step.x, step.y));
            left = quad.yz;
            below[i] = quad.xy;
        }
    }
    return steps;
}

void main() {
    int size_px = textureSize(depthMaps, 0).x;
    ivec3 block = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(8 * block.xy, ivec2(size_px)))) return;

    Steps nearest = stepsIn(depthMaps, block, float(size_px));
    bool isEdge = nearest.least == 0.0 && nearest.most > 0.0;  // an outline
    if (edges.kinds > 1) isEdge = isEdge || nearest.most > 0.0 && nearest.greatest > jumpBelow(block.z, nearest.least);
    if (edges.kinds > 2) {
        Steps farthest = stepsIn(farthestMaps, block, float(size_px));
        isEdge = isEdge || farthest.least < 1.0 && farthest.greatest > jumpBelow(block.z, farthest.least);
    }
    if (isEdge) edgeBlocks[atomicAdd(blockCount, 1u)] = uint(block.x) | uint(block.y) << 10 | uint(block.z) << 20;
}
