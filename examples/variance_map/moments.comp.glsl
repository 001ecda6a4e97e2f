// SPDX-License-Identifier: Apache-2.0
#version 450
// Mean and mean square of what the map stores, along one axis: run twice it is a square (section 3).
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/variance_map/variance_io.h"

uniform sampler2DArray source;
uniform writeonly image2DArray moments;
layout(std140) uniform Constants { MomentsConstants pass; };

void main() {
    ivec3 texel = ivec3(gl_GlobalInvocationID);
    ivec2 last = textureSize(source, 0).xy - 1;
    if (any(greaterThan(texel.xy, last))) return;
    vec2 sum = vec2(0.0);
    for (int i = -pass.radius_px; i <= pass.radius_px; ++i) {
        ivec2 place = clamp(texel.xy + (pass.isAcross ? ivec2(i, 0) : ivec2(0, i)), ivec2(0), last);
        vec2 stored = texelFetch(source, ivec3(place, texel.z), 0).rg;
        sum += pass.isAcross ? vec2(stored.r, stored.r * stored.r) : stored;
    }
    imageStore(moments, texel, vec4(sum / float(2 * pass.radius_px + 1), 0.0, 0.0));
}
