// SPDX-License-Identifier: Apache-2.0
#version 450
// What a textured light radiates beyond each place on it, in the direction from its centre: what the thesis has in a table
// of four dimensions (section 4.2.7), and two are enough for along an edge. See light_table.glsl.
layout(local_size_x = 512) in;

#include "src/techniques/soft_shadow_volumes/volumes_io.h"
#include "src/techniques/soft_shadow_volumes/light_table.glsl"

uniform sampler2D radiance;
layout(rgba32f) uniform writeonly image2D table;

shared vec3 sums[tableColumns];

// What is radiated between two rows, a step towards the border.
vec3 radiatedIn(int row, vec2 border) {
    float middle = (float(row) + 0.5) / float(tableRows);
    ivec2 picture = textureSize(radiance, 0), texel = ivec2((0.5 + 0.5 * middle * border) * vec2(picture));
    return middle * max(texelFetch(radiance, clamp(texel, ivec2(0), picture - 1), 0).rgb, 0.0);
}

void main() {
    int column = int(gl_LocalInvocationIndex);
    vec2 border = borderAt((float(column) + 0.5) / float(tableColumns) * 4.0);
    vec3 sum = vec3(0.0);
    for (int row = 0; row < tableRows; ++row) sum += radiatedIn(row, border);
    sums[column] = sum;
    barrier();
    vec3 all = vec3(0.0);
    for (int i = 0; i < tableColumns; ++i) all += sums[i];
    // Shares of all that is radiated, for a direction as wide as a quarter of them all; of a channel that is black all over,
    // shares of the light's area.
    vec3 scale = float(tableColumns) * 0.25 / max(all, 1e-30);
    vec3 beyond = vec3(0.0);
    imageStore(table, ivec2(column, tableRows), vec4(0.0));
    for (int row = tableRows - 1; row >= 0; --row) {
        beyond += radiatedIn(row, border);
        float low = float(row) / float(tableRows);
        vec3 share = mix(vec3(0.25 * (1.0 - low * low)), beyond * scale, greaterThan(all, vec3(0.0)));
        imageStore(table, ivec2(column, row), vec4(share, 0.0));
    }
}
