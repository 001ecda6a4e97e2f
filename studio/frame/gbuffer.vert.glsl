// SPDX-License-Identifier: Apache-2.0
#version 450
#include "studio/frame/gbuffer_io.h"

layout(std140, binding = 0) uniform InstanceBlock { InstanceConstants instance; };

layout(location = 0) in vec3 posMesh;
layout(location = 1) in vec3 normalMesh;
layout(location = 2) in vec2 uvMesh;
layout(location = 3) in vec3 colorMesh;

layout(location = 0) out vec3 posView;
layout(location = 1) out vec3 normalView;
layout(location = 2) out vec2 uv;
layout(location = 3) out vec3 color;

void main() {
    gl_Position = instance.clipFromMesh * vec4(posMesh, 1.0);
    posView = (instance.viewFromMesh * vec4(posMesh, 1.0)).xyz;
    normalView = mat3(instance.viewFromMeshNormal) * normalMesh;
    uv = uvMesh;
    color = instance.alpha.y > 0.5 ? colorMesh : vec3(1.0);
}
