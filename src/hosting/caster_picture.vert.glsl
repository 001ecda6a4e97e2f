// SPDX-License-Identifier: Apache-2.0
#version 450
#include "src/hosting/caster_picture_io.h"

layout(std140) uniform Constants { CasterPictureConstants picture; };

in vec3 posMesh;
in vec2 uvMesh;
layout(location = 0) out vec2 uv;
layout(location = 1) out float distanceFromEye;

void main() {
    gl_Position = picture.clipFromMesh * vec4(posMesh, 1.0);
    uv = uvMesh;
    distanceFromEye = gl_Position.w;
}
