// SPDX-License-Identifier: Apache-2.0
#version 450
// A sample of a textured light stands for its cell of the lattice: its weight is the mean radiance there, and not that
// of a point, which pictures finer than the lattice would make a matter of chance.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/exact_visibility/exact_io.h"
layout(std140) uniform LightBlock { ExactLight light; };
#include "src/techniques/exact_visibility/weights.glsl"

layout(std430) buffer Weights { uint weightsChangedAt; vec4 weights[]; };
layout(std140) uniform Constants { ExactLook look; };
uniform sampler2D radiance;

void main() {
    ivec2 ij = ivec2(gl_GlobalInvocationID.xy);
    int lattice = int(gl_GlobalInvocationID.z);
    if (any(greaterThanEqual(ij, ivec2(EXACT_MAX_ROWS)))) return;
    int row = lattice * EXACT_MAX_ROWS + ij.y;
    if ((light.valid[row >> 2][row & 3] >> uint(ij.x) & 1u) == 0u) return;

    const int taps = 24;
    vec3 sum = vec3(0.0);
    float count = 0.0;
    for (int k = 0; k < taps * taps; ++k) {
        vec2 place = (vec2(k % taps, k / taps) + 0.5) / float(taps) - 0.5;
        vec2 p = vec2(ij) + place - light.offsets[lattice].xy;
        vec2 uv = p.x * light.uvFromI + p.y * light.uvFromJ;
        if (max(abs(uv.x), abs(uv.y)) > 1.0) continue;
        sum += emitted(textureLod(radiance, 0.5 * uv + 0.5, 0.0).rgb);
        count += 1.0;
    }
    vec4 mean = vec4(sum / count, 0.0);  // the sample itself lies inside
    int place = weightIndex(lattice, ij.x, ij.y);
    if (weights[place] != mean) weightsChangedAt = look.serial;
    weights[place] = mean;
}
