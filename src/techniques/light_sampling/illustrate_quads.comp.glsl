// SPDX-License-Identifier: Apache-2.0
#version 450
// The subdivision as it lies on the light's unit square: lines between quads, dots at samples.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/light_sampling/subdivision_io.h"

layout(std430) readonly buffer SubdivisionBlock { Subdivision subdivision; };
#include "src/techniques/light_sampling/subdivision.glsl"

layout(rgba8) uniform writeonly image2D picture;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThan(texel, ivec2(256)))) return;
    float value = 0.0;
    for (int level = 0; level <= deepestLevel; ++level) {
        int side = 256 >> level;
        ivec2 quad = min(texel / side, ivec2((1 << level) - 1));
        ivec2 within = texel - quad * side;
        bool isLine = any(equal(within, ivec2(0))) || any(equal(within, ivec2(side)));
        if (isLine && isLeaf(level, quad)) value = 0.5;
    }
    ivec2 vertex = (texel + 8) / 16;
    ivec2 offset = abs(texel - 16 * vertex);
    if (offset.x + offset.y <= 2 && subdivision.slotOfVertex[vertex.y * latticeSide + vertex.x] >= 0) value = 1.0;
    imageStore(picture, texel, vec4(vec3(value), 1.0));
}
