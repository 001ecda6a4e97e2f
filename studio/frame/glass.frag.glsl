// SPDX-License-Identifier: Apache-2.0
#version 450
// Panes: blending multiplies what is behind by their colour.
#include "studio/frame/gbuffer_io.h"

layout(std140) uniform Constants { InstanceConstants instance; };

layout(location = 3) in vec3 vertexColor;

layout(location = 0) out vec4 albedoFactor;
layout(location = 1) out vec4 emissionFactor;

void main() {
    albedoFactor = emissionFactor = vec4(instance.baseColor.rgb * vertexColor, 1.0);
}
