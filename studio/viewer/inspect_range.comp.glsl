// SPDX-License-Identifier: Apache-2.0
#version 450
// The least and the largest number in one layer of a texture. Numbers are compared as unsigned integers that are in
// the same order, so that the result does not depend on the order of the invocations.
layout(local_size_x = 8, local_size_y = 8) in;

#include "studio/viewer/inspected.glsl"

layout(std430) buffer Range {
    uint least;
    uint largest;
};

uint ordered(float value) {
    uint bits = floatBitsToUint(value);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, inspect.size_px))) return;
    vec4 value = inspectedAt(pixel);
    for (int channel = 0; channel < (inspect.isGrey ? 1 : 3); ++channel) {
        if (isnan(value[channel]) || isinf(value[channel])) continue;
        atomicMin(least, ordered(value[channel]));
        atomicMax(largest, ordered(value[channel]));
    }
}
