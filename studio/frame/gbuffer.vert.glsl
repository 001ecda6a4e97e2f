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
// Of the planes that touch the smooth surface at the corners: of n n^T the diagonal and the rest, and n (n . p).
layout(location = 4) out vec3 tangentDiagonal;
layout(location = 5) out vec3 tangentRest;
layout(location = 6) out vec3 tangentOffset;

void main() {
    gl_Position = instance.clipFromMesh * vec4(posMesh, 1.0);
    posView = (instance.viewFromMesh * vec4(posMesh, 1.0)).xyz;
    normalView = mat3(instance.viewFromMeshNormal) * normalMesh;
    float size = length(normalView);
    vec3 n = size > 0.0 ? normalView / size : vec3(0.0);
    tangentDiagonal = n * n;
    tangentRest = n.yzx * n.zxy;
    tangentOffset = n * dot(n, posView);
    uv = uvMesh;
    color = instance.hasVertexColors ? colorMesh : vec3(1.0);
}
