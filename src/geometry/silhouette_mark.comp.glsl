// SPDX-License-Identifier: Apache-2.0
#version 450
// Marks the silhouette edges of a mesh, block by block.
layout(local_size_x = 256) in;

#include "src/geometry/silhouettes_io.h"
#include "src/geometry/silhouette_block.glsl"

layout(std430) writeonly buffer Marks { uint marks[]; };

shared uint words[wordsPerBlock];

void main() {
    uint lane = gl_LocalInvocationID.x;
    if (lane < wordsPerBlock) words[lane] = 0u;
    barrier();
    uint edge = gl_GlobalInvocationID.x;
    if (edge < mesh.edgeCount && silhouetteWeight(edges[edge]) != 0) atomicOr(words[lane >> 5], 1u << (lane & 31u));
    barrier();
    if (lane < wordsPerBlock) marks[(mesh.firstBlock + gl_WorkGroupID.x) * wordsPerBlock + lane] = words[lane];
}
