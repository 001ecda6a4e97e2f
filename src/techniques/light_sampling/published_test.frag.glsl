// SPDX-License-Identifier: Apache-2.0
#version 450
// The second pass of the comparison (section 3.3.3): a fragment in the penumbra of a quad's corners fails where no
// neighbour has another sum. What is left after the discarding is what the occlusion query counts.
#include "src/techniques/light_sampling/published_io.h"

uniform usampler2D sums;
layout(std140) uniform Constants { PublishedConstants constants; };

out vec4 color;  // brighter the finer the level

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    uint sum = texelFetch(sums, texel, 0).r;
    if (sum == 0u || sum == uint(constants.corners)) discard;
    for (int i = 0; i < 9; ++i) {
        ivec2 neighbour = clamp(texel + ivec2(i % 3, i / 3) - 1, ivec2(0), constants.target_px - 1);
        if (texelFetch(sums, neighbour, 0).r != sum) discard;
    }
    color = vec4(vec3(constants.brightness), 1.0);
}
