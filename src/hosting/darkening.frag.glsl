// SPDX-License-Identifier: Apache-2.0
#version 450
// What a picture is multiplied by (host_framebuffer.cpp).
#include "src/hosting/darkening_io.h"

uniform sampler2D visibility;
layout(std140) uniform Constants { DarkeningConstants darkening; };

layout(location = 0) out vec4 factor;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy) - darkening.pictureCorner_px + darkening.visibilityCorner_px;
    vec3 seen = texelFetch(visibility, pixel, 0).rgb;
    factor = vec4(mix(vec3(darkening.leastLit), vec3(1.0), darkening.isColored ? seen : vec3(seen.r)), 1.0);
}
