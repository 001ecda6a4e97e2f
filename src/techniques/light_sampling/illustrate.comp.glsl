// SPDX-License-Identifier: Apache-2.0
#version 450
// Figure 6: the root quad's sums in colours, and the fragments that fail, brighter the finer the level.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/light_sampling/subdivision_io.h"
#include "src/techniques/light_sampling/lattice_bits.glsl"

uniform usampler2D shadowBits;
layout(std430) readonly buffer SubdivisionBlock { Subdivision subdivision; };
#include "src/techniques/light_sampling/examine.glsl"
#include "src/techniques/light_sampling/subdivision.glsl"

layout(rgba8) uniform writeonly image2D sumsPicture;
layout(rgba8) uniform writeonly image2D failingPicture;

void main() {
    ivec2 size_px = textureSize(shadowBits, 0);
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, size_px))) return;
    uvec4 ring[9];
    for (int i = 0; i < 9; ++i) {
        ring[i] = texelFetch(shadowBits, clamp(texel + ivec2(i % 3, i / 3) - 1, ivec2(0), size_px - 1), 0);
    }
    Sums sums = sumsOfRow(ring[4], 0, 8);
    uint sum = (sums.ones & 1u) + 2u * (sums.twos & 1u) + 4u * (sums.fours & 1u);
    imageStore(sumsPicture, texel, vec4(sum == 1u, sum == 2u, sum == 3u, 1.0));

    float brightness = 0.0;
    for (int level = 0; level < deepestLevel; ++level) {
        uint fails = 0u;
        for (int y = 0; y < (1 << level); ++y) {
            uint failing = failingInRow(ring, y * (8 >> level), 8 >> level);
            for (int x = 0; x < (1 << level); ++x) {
                if (quadExists(level, ivec2(x, y))) fails |= failing & (1u << (x * (8 >> level)));
            }
        }
        if (fails != 0u) brightness = 0.25 * float(level + 1);
    }
    imageStore(failingPicture, texel, vec4(vec3(brightness), 1.0));
}
