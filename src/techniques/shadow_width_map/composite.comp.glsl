// SPDX-License-Identifier: Apache-2.0
#version 450
// One step of the published construction on graphics hardware (section 4, "Generating Shadow Widths"): the least of a
// texel and of its neighbours plus a difference. Blockers start as 1, all else as 0.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/shadow_width_map/shadow_width_io.h"

layout(std140) uniform Constants { CompositeConstants composite; };
uniform sampler2DArray depthMaps;
uniform sampler2DArray before;
layout(r32f) uniform writeonly image2DArray after;

void main() {
    ivec3 texel = ivec3(gl_GlobalInvocationID);
    ivec2 last = imageSize(after).xy - 1;
    if (any(greaterThan(texel.xy, last))) return;
    float width;
    if (composite.neighbours == 0) {
        width = texelFetch(depthMaps, texel, 0).r == composite.background ? 0.0 : 1.0;
    } else {
        width = texelFetch(before, texel, 0).r;
        for (int i = 0; i < composite.neighbours; ++i) {
            float angle = 6.2831853 * (float(i) + 0.25) / float(composite.neighbours);
            ivec2 there = texel.xy + ivec2(round(composite.distance_px * vec2(cos(angle), sin(angle))));
            width = min(width, texelFetch(before, ivec3(clamp(there, ivec2(0), last), texel.z), 0).r + composite.difference);
        }
    }
    imageStore(after, texel, vec4(width));
}
