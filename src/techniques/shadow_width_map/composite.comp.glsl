// SPDX-License-Identifier: Apache-2.0
#version 450
// One step of the published construction on graphics hardware (section 4, "Generating Shadow Widths"): the least of a
// texel and of its neighbours plus a difference. Blockers start as 1, all else as 0.
layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2DArray depthMaps;
layout(binding = 1) uniform sampler2DArray before;
layout(binding = 0, r32f) uniform writeonly image2DArray after;
layout(location = 0) uniform int neighbours;     // 3 or 6, evenly around; 0: the inverted occlusion map itself
layout(location = 1) uniform float distance_px;
layout(location = 2) uniform float difference;
layout(location = 3) uniform float background;   // the depth where there is no caster

void main() {
    ivec3 texel = ivec3(gl_GlobalInvocationID);
    ivec2 last = imageSize(after).xy - 1;
    if (any(greaterThan(texel.xy, last))) return;
    float width;
    if (neighbours == 0) {
        width = texelFetch(depthMaps, texel, 0).r == background ? 0.0 : 1.0;
    } else {
        width = texelFetch(before, texel, 0).r;
        for (int i = 0; i < neighbours; ++i) {
            float angle = 6.2831853 * (float(i) + 0.25) / float(neighbours);
            ivec2 there = texel.xy + ivec2(round(distance_px * vec2(cos(angle), sin(angle))));
            width = min(width, texelFetch(before, ivec3(clamp(there, ivec2(0), last), texel.z), 0).r + difference);
        }
    }
    imageStore(after, texel, vec4(width));
}
