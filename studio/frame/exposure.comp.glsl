// SPDX-License-Identifier: Apache-2.0
#version 450
// The exposure at which the unshadowed picture's mean is mid-grey: the same for every technique. One work group, so
// that the sums are always taken in the same order.
layout(local_size_x = 256) in;

uniform sampler2D unshadowedTexture;
layout(std430) writeonly buffer Exposure { float exposure; };

shared vec2 sums[256];

void main() {
    ivec2 size = textureSize(unshadowedTexture, 0);
    int self = int(gl_LocalInvocationID.x);
    vec2 sum = vec2(0.0);
    for (int i = self; i < size.x * size.y; i += 256) {
        vec4 radiance = texelFetch(unshadowedTexture, ivec2(i % size.x, i / size.x), 0);
        float luminance = dot(radiance.rgb, vec3(0.2126, 0.7152, 0.0722));
        if (luminance > 0.0) sum += vec2(luminance, 1.0);
    }
    sums[self] = sum;
    for (int width = 128; width > 0; width /= 2) {
        barrier();
        if (self < width) sums[self] += sums[self + width];
    }
    if (self == 0) {
        float mean = sums[0].y > 0.0 ? sums[0].x / sums[0].y : 0.0;
        exposure = mean > 0.0 ? 0.4 / mean : 1.0;
    }
}
