// SPDX-License-Identifier: Apache-2.0
#version 450
#ifndef LAYER_BY_LAYER
#extension GL_ARB_shader_viewport_layer_array : require
#endif
// Variants: LAYER_BY_LAYER, where the framebuffer holds a single layer; MASKED, where casters have holes.
#include "src/techniques/common/depth_map_io.h"
#include "src/techniques/common/light_camera_io.h"
#include "src/techniques/common/light_plane.glsl"

layout(std430) readonly buffer Cameras { LightCameraConstants cameras[]; };
layout(std430) readonly buffer Casters { CasterConstants casters[]; };
layout(std140) uniform Constants { DepthMapConstants constants; };

in vec3 posMesh;
in ivec2 layerAndCaster;  // one an instance
#ifdef MASKED
in vec2 uvMesh;
layout(location = 0) out vec2 uv;
layout(location = 1) flat out vec2 alpha;  // factor, cutoff
#endif

out float gl_CullDistance[1];

void main() {
    int layer = layerAndCaster.x;
    CasterConstants caster = casters[layerAndCaster.y];
    vec4 posLight = caster.lightFromMesh * vec4(posMesh, 1.0);
    gl_Position = cameras[layer].clipFromLight * posLight;
    // A triangle that lies in the light's plane, or behind it, hides nothing.
    gl_CullDistance[0] = insideEmission(posLight.xyz, constants.light);
#ifdef MASKED
    uv = uvMesh;
    alpha = vec2(caster.alphaFactor, caster.alphaCutoff);
#endif
#ifndef LAYER_BY_LAYER
    gl_Layer = layer;
#endif
}
