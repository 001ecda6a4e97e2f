// SPDX-License-Identifier: Apache-2.0
#version 450
// A rectangle from one texture into another of any format (texture_copy.h). Variant: MULTISAMPLED.
layout(local_size_x = 8, local_size_y = 8) in;

#ifdef MULTISAMPLED
layout(binding = 0) uniform sampler2DMS source;
#else
layout(binding = 0) uniform sampler2D source;
#endif
layout(binding = 0) uniform writeonly image2D target;

layout(location = 0) uniform ivec4 corners;  // xy: of the source; zw: of the target
layout(location = 1) uniform ivec2 size_px;
layout(location = 2) uniform int lookedAt;  // which sample; level 0 of a texture that has one only

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, size_px))) return;
    imageStore(target, pixel + corners.zw, texelFetch(source, pixel + corners.xy, lookedAt));
}
