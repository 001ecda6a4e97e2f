// SPDX-License-Identifier: Apache-2.0
#version 450
// A rectangle from one texture into another of any format (texture_copy.h). Variant: MULTISAMPLED.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/hosting/texture_copy_io.h"

#ifdef MULTISAMPLED
uniform sampler2DMS source;
#else
uniform sampler2D source;
#endif
uniform writeonly image2D target;
layout(std140) uniform Constants { TextureCopyConstants copy; };

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, copy.size_px))) return;
    vec4 texel = texelFetch(source, pixel + copy.sourceCorner_px, copy.lookedAt);
    imageStore(target, pixel + copy.targetCorner_px, copy.isGray ? texel.rrra : texel);
}
