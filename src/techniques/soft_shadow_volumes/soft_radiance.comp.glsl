// SPDX-License-Identifier: Apache-2.0
#version 450
// What each sample of a textured light stands for: the mean radiance around it.
layout(local_size_x = 64) in;

#include "src/techniques/soft_shadow_volumes/volumes_io.h"

layout(std430) readonly buffer Samples { vec4 samples[]; };
layout(std430) writeonly buffer Radiances { vec4 radiances[]; };
uniform sampler2D radiance;
layout(std140) uniform Constants { PointsConstants points; };

const int taps = 8;

void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i >= points.count) return;
    float cell = inversesqrt(float(points.count));
    vec2 middle = 0.5 + 0.5 * samples[i].xy;
    ivec2 size = textureSize(radiance, 0);
    vec3 sum = vec3(0.0);
    for (int y = 0; y < taps; ++y) {
        for (int x = 0; x < taps; ++x) {
            vec2 place = middle + cell * ((vec2(x, y) + 0.5) / float(taps) - 0.5);
            sum += texelFetch(radiance, clamp(ivec2(place * vec2(size)), ivec2(0), size - 1), 0).rgb;
        }
    }
    radiances[i] = vec4(max(sum / float(taps * taps), 0.0), 1.0);
}
