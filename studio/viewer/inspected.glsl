// SPDX-License-Identifier: Apache-2.0
// One layer of the texture that is looked into.

#ifdef LAYERED
layout(binding = 0) uniform sampler2DArray inspected;
#else
layout(binding = 0) uniform sampler2D inspected;
#endif
layout(location = 0) uniform ivec2 size;
layout(location = 2) uniform int layer;
layout(location = 3) uniform bool grey;  // the texture has one channel

vec4 inspectedAt(ivec2 pixel) {
#ifdef LAYERED
    return texelFetch(inspected, ivec3(pixel, layer), 0);
#else
    return texelFetch(inspected, pixel, 0);
#endif
}
