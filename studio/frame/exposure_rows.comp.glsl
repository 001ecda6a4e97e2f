// SPDX-License-Identifier: Apache-2.0
#version 450
// Sums the luminances of a row that is lit, a work group each, and counts its pixels: what exposure.comp.glsl adds up.
// A loop over all pixels at once is too long for some drivers: llvmpipe leaves after 65,535 rounds.
layout(local_size_x = 256) in;

uniform sampler2D unshadowedTexture;
layout(std430) writeonly buffer RowSums { vec2 rowSums[]; };

shared vec2 sums[256];

void main() {
    int row = int(gl_WorkGroupID.x), self = int(gl_LocalInvocationID.x), columns = textureSize(unshadowedTexture, 0).x;
    vec2 sum = vec2(0.0);
    for (int column = self; column < columns; column += 256) {
        vec4 radiance = texelFetch(unshadowedTexture, ivec2(column, row), 0);
        float luminance = dot(radiance.rgb, vec3(0.2126, 0.7152, 0.0722));
        if (luminance > 0.0) sum += vec2(luminance, 1.0);
    }
    sums[self] = sum;
    for (int width = 128; width > 0; width /= 2) {
        barrier();
        if (self < width) sums[self] += sums[self + width];
    }
    if (self == 0) rowSums[row] = sums[0];
}
