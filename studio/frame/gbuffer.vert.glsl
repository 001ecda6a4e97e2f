// SPDX-License-Identifier: Apache-2.0
#version 450
#include "studio/frame/gbuffer_io.h"

layout(std140) uniform Constants { InstanceConstants instance; };

in vec3 posMesh;
in vec3 normalMesh;
in vec2 uvMesh;
in vec3 colorMesh;

layout(location = 0) out vec3 posView;
layout(location = 1) out vec3 normalView;
layout(location = 2) out vec2 uv;
layout(location = 3) out vec3 color;

void main() {
    gl_Position = instance.clipFromMesh * vec4(posMesh, 1.0);
    posView = (instance.viewFromMesh * vec4(posMesh, 1.0)).xyz;
    normalView = mat3(instance.viewFromMeshNormal) * normalMesh;
    uv = uvMesh;
    color = instance.hasVertexColors ? colorMesh : vec3(1.0);
}
