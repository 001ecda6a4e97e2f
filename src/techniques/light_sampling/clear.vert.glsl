// SPDX-License-Identifier: Apache-2.0
#version 450
#ifndef LAYER_BY_LAYER
#extension GL_ARB_shader_viewport_layer_array : require
#endif
// A triangle over the whole of each map of a batch, infinitely far away.
#define PLAN_BLOCK 3
#include "src/techniques/light_sampling/batch.glsl"

void main() {
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
#ifndef LAYER_BY_LAYER
    gl_Layer = layerOf(firstSlot()) + gl_InstanceID;
#endif
}
