// SPDX-License-Identifier: Apache-2.0
#version 450
// See CasterPicture::Pixel and CasterPainter.
#include "src/hosting/caster_picture_io.h"

uniform sampler2D alphaTexture;
layout(std140) uniform Constants { CasterPictureConstants picture; };

layout(location = 0) in vec2 uv;
layout(location = 1) in float distanceFromEye;
layout(location = 0) out vec4 pixel;
layout(location = 1) out vec2 slopes;

void main() {
    slopes = vec2(dFdx(gl_FragCoord.z), dFdy(gl_FragCoord.z));
    if (picture.hasMask && texture(alphaTexture, uv).a * picture.alphaFactor < picture.alphaCutoff) discard;
    pixel = vec4(gl_FragCoord.z, distanceFromEye, picture.caster, 1.0);
}
