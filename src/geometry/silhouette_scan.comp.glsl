// SPDX-License-Identifier: Apache-2.0
#version 450
// Where each block's silhouette edges go in the list: the number of those in the blocks before it.
layout(local_size_x = 256) in;

#include "src/geometry/silhouettes_io.h"

const uint wordsPerBlock = 8u;

layout(std430) readonly buffer Marks { uint marks[]; };
layout(std430) writeonly buffer Offsets { uint offsets[]; };
layout(std430) writeonly buffer Commands { SilhouetteCommands commands; };

layout(std140) uniform Constants { ScanConstants list; };

shared uint sums[256];

uint countIn(uint block) {
    uint count = 0u;
    for (uint i = 0u; i < wordsPerBlock; ++i) count += uint(bitCount(marks[block * wordsPerBlock + i]));
    return count;
}

void main() {
    // Each lane adds up a run of blocks, then all lanes' sums are scanned (Hillis and Steele 1986).
    uint lane = gl_LocalInvocationID.x;
    uint run = (list.blockCount + 255u) / 256u;
    uint begin = min(lane * run, list.blockCount);
    uint end = min(begin + run, list.blockCount);
    uint sum = 0u;
    for (uint block = begin; block < end; ++block) sum += countIn(block);
    sums[lane] = sum;
    barrier();
    for (uint step = 1u; step < 256u; step *= 2u) {
        uint before = lane >= step ? sums[lane - step] : 0u;
        barrier();
        sums[lane] += before;
        barrier();
    }

    uint offset = sums[lane] - sum;
    for (uint block = begin; block < end; ++block) {
        offsets[block] = offset;
        offset += countIn(block);
    }
    if (lane == 255u) {
        uint count = sums[255];
        commands.vertexCount = count * list.verticesPerEdge;
        commands.instanceCount = list.instances;
        commands.firstVertex = 0u;
        commands.baseInstance = 0u;
        commands.groupsX = (count + 63u) / 64u;
        commands.groupsY = 1u;
        commands.groupsZ = 1u;
        commands.edgeCount = count;
    }
}
