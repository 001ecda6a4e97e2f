// SPDX-License-Identifier: Apache-2.0
// One layer of the texture that is looked into.
#include "studio/viewer/canvas_io.h"

#ifdef LAYERED
uniform sampler2DArray inspected;
#else
uniform sampler2D inspected;
#endif
layout(std140) uniform Constants { InspectConstants inspect; };

vec4 inspectedAt(ivec2 pixel) {
#ifdef LAYERED
    return texelFetch(inspected, ivec3(pixel, inspect.layer), 0);
#else
    return texelFetch(inspected, pixel, 0);
#endif
}
