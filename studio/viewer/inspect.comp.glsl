// SPDX-License-Identifier: Apache-2.0
#version 450
// A texture as a picture: one layer, from black to white over a range that is given, or over what is in it.
layout(local_size_x = 8, local_size_y = 8) in;

#include "studio/viewer/inspected.glsl"

// From inspect_range.comp.glsl.
layout(std430) readonly buffer Range {
    uint least;
    uint largest;
};
layout(rgba8) uniform writeonly image2D picture;

float unordered(uint bits) {
    return uintBitsToFloat((bits & 0x80000000u) != 0u ? bits & 0x7fffffffu : ~bits);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, inspect.size_px))) return;
    vec4 value = inspectedAt(pixel);
    vec2 ends = inspect.isStretched && least < largest ? vec2(unordered(least), unordered(largest))
                                                         : vec2(inspect.black, inspect.white);
    vec3 shown = (value.rgb - ends.x) / (ends.y - ends.x);
    if (inspect.isGrey) shown = shown.rrr;
    // What is not a number shall catch the eye, not vanish.
    if (any(isnan(shown))) shown = vec3(1.0, 0.0, 1.0);
    imageStore(picture, pixel, vec4(clamp(shown, 0.0, 1.0), 1.0));
}
