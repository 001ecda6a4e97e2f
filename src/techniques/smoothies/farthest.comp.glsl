// SPDX-License-Identifier: Apache-2.0
#version 450
// The farthest surface that the light sees in each tile of its window, by every fourth texel: it bounds how wide the
// smoothies thereabouts can become.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/smoothies/smoothies.glsl"
#include "src/techniques/smoothies/surfaces.glsl"
#include "src/techniques/smoothies/smoothie_edges_io.h"

layout(std430, binding = 2) writeonly buffer Tiles { float farthestNearness[]; };

shared uint smallest;

// Floats in the order of unsigned integers.
uint ordered(float value) {
    uint bits = floatBitsToUint(value);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

float unordered(uint bits) {
    return uintBitsToFloat((bits & 0x80000000u) != 0u ? bits & 0x7fffffffu : ~bits);
}

void main() {
    if (gl_LocalInvocationIndex == 0u) smallest = 0xffffffffu;
    barrier();
    int size_px = textureSize(depthMaps, 0).x;
    int camera = int(gl_WorkGroupID.z);
    ivec2 begin = ivec2(gl_WorkGroupID.xy) * size_px / tilesAcross;
    ivec2 end = (ivec2(gl_WorkGroupID.xy) + 1) * size_px / tilesAcross;
    float nearness = smoothies[camera].nearness.y;
    for (int y = begin.y + 4 * int(gl_LocalInvocationID.y); y < end.y; y += 32) {
        for (int x = begin.x + 4 * int(gl_LocalInvocationID.x); x < end.x; x += 32) {
            ivec2 texel = ivec2(x, y);
            nearness = min(nearness, max(blockerNearness(camera, camera, texel), receiverNearness(camera, camera, texel)));
        }
    }
    atomicMin(smallest, ordered(nearness));
    barrier();
    if (gl_LocalInvocationIndex == 0u) {
        uint tile = (gl_WorkGroupID.z * uint(tilesAcross) + gl_WorkGroupID.y) * uint(tilesAcross) + gl_WorkGroupID.x;
        farthestNearness[tile] = unordered(smallest);
    }
}
