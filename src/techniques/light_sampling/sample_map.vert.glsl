// SPDX-License-Identifier: Apache-2.0
#version 450
#ifndef LAYER_BY_LAYER
#extension GL_ARB_shader_viewport_layer_array : require
#endif
// Variants: LAYER_BY_LAYER, where the framebuffer holds a single layer; MASKED, where casters have holes.
#include "src/techniques/common/depth_map_io.h"
#include "src/techniques/common/light_camera_io.h"

layout(std430, binding = 0) readonly buffer Cameras { LightCameraConstants cameras[]; };
layout(std430, binding = 1) readonly buffer Casters { CasterConstants casters[]; };
layout(std430, binding = 2) readonly buffer LayerLists { int layerLists[]; };

layout(location = 0) uniform int caster;
layout(location = 1) uniform int firstInLayerLists;

layout(location = 0) in vec3 posMesh;
#ifdef MASKED
layout(location = 1) in vec2 uvMesh;
layout(location = 0) out vec2 uv;
layout(location = 1) flat out vec2 alpha;
#endif

void main() {
    int layer = layerLists[firstInLayerLists + gl_InstanceID];
    gl_Position = cameras[layer].clipFromLight * (casters[caster].lightFromMesh * vec4(posMesh, 1.0));
#ifdef MASKED
    uv = uvMesh;
    alpha = vec2(casters[caster].alphaFactor, casters[caster].alphaCutoff);
#endif
#ifndef LAYER_BY_LAYER
    gl_Layer = layer;
#endif
}
