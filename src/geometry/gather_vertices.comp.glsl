// SPDX-License-Identifier: Apache-2.0
#version 450
// Packs vectors or indices of a host's buffer tightly (host_buffers.h).
layout(local_size_x = 256) in;

#include "src/geometry/gather_vertices_io.h"

layout(std430) readonly buffer Source { uint source[]; };
layout(std430) writeonly buffer Target { uint target[]; };

layout(std140) uniform Constants { GatherConstants wanted; };

void main() {
    uint i = wanted.first + gl_GlobalInvocationID.x;
    if (i >= wanted.count) return;
    if (wanted.wordsEach == 0u) {
        uint place = wanted.offset + i;
        target[i] = bitfieldExtract(source[place >> 1], int(16u * (place & 1u)), 16);
    }
    for (uint word = 0u; word < wanted.wordsEach; ++word)
        target[wanted.wordsEach * i + word] = source[wanted.offset + wanted.stride * i + word];
}
