// SPDX-License-Identifier: Apache-2.0
#version 450
// Packs vectors or indices of a host's buffer tightly (host_buffers.h).
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Source { uint source[]; };
layout(std430, binding = 1) writeonly buffer Target { uint target[]; };

layout(location = 0) uniform uint first;  // of this dispatch
layout(location = 1) uniform uint count;
layout(location = 2) uniform uint offset;    // of the first: words, or halves where wordsEach is 0
layout(location = 3) uniform uint stride;    // in words
layout(location = 4) uniform uint wordsEach; // 0: halves of a word, which become words

void main() {
    uint i = first + gl_GlobalInvocationID.x;
    if (i >= count) return;
    if (wordsEach == 0u) {
        uint place = offset + i;
        target[i] = bitfieldExtract(source[place >> 1], int(16u * (place & 1u)), 16);
    }
    for (uint word = 0u; word < wordsEach; ++word) target[wordsEach * i + word] = source[offset + stride * i + word];
}
