// SPDX-License-Identifier: Apache-2.0
#version 450
// Shares of a textured light's radiance: the mean over each cell of the unit square, times its area.
layout(local_size_x = 64) in;

#include "src/techniques/light_sampling/sampling_io.h"

uniform sampler2D radiance;
layout(std430) readonly buffer Cells { vec4 cells[]; };  // xy: min; zw: max
layout(std430) buffer Samples { LightSample samples[]; };

layout(std140) uniform Constants { WeighConstants constants; };

vec3 emitted(ivec2 texel, ivec2 size_px) {
    vec3 value = texelFetch(radiance, clamp(texel, ivec2(0), size_px - 1), 0).rgb;
    return vec3(value.r > 0.0 ? min(value.r, 1e30) : 0.0, value.g > 0.0 ? min(value.g, 1e30) : 0.0,
                value.b > 0.0 ? min(value.b, 1e30) : 0.0);
}

// Bilinear and clamped to the edge, whatever the texture's own sampling is.
vec3 radianceAt(vec2 square, ivec2 size_px) {
    vec2 at = square * vec2(size_px) - 0.5;
    ivec2 low = ivec2(floor(at));
    vec2 f = at - floor(at);
    return mix(mix(emitted(low, size_px), emitted(low + ivec2(1, 0), size_px), f.x),
               mix(emitted(low + ivec2(0, 1), size_px), emitted(low + ivec2(1, 1), size_px), f.x), f.y);
}

void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i >= constants.count) return;
    ivec2 size_px = textureSize(radiance, 0);
    vec4 cell = cells[i];
    vec2 extent = cell.zw - cell.xy;
    // A tap a texel, within reason.
    ivec2 taps = clamp(ivec2(ceil(extent * vec2(size_px))), ivec2(1), ivec2(32));
    vec3 sum = vec3(0.0);
    for (int y = 0; y < taps.y; ++y) {
        for (int x = 0; x < taps.x; ++x) {
            sum += radianceAt(cell.xy + extent * (vec2(x, y) + 0.5) / vec2(taps), size_px);
        }
    }
    samples[i].radianceShare = sum / float(taps.x * taps.y) * samples[i].areaShare;
}
