// SPDX-License-Identifier: Apache-2.0
#version 450
// Puts the batch's cameras in the order of its layers (the last group), and lists for each caster (a group each) the
// layers whose camera might see it. Variant LAYER_BY_LAYER: a command a caster and layer instead of one a caster.
layout(local_size_x = 64) in;

#define PLAN_BLOCK 0
#include "src/techniques/light_sampling/batch.glsl"

layout(std430, binding = 1) readonly buffer Slots { int sampleOfSlot[]; };
layout(std430, binding = 2) readonly buffer Cameras { SampleCamera cameras[]; };
layout(std430, binding = 3) writeonly buffer LayerTaps { LayerTap layerTaps[]; };
layout(std430, binding = 4) writeonly buffer LayerCameras { LightCameraConstants layerCameras[]; };
layout(std430, binding = 5) readonly buffer Boxes { CullBox boxes[]; };
layout(std430, binding = 6) writeonly buffer LayerLists { int layerLists[]; };
layout(std430, binding = 7) writeonly buffer Commands { DrawCommand commands[]; };

layout(location = 5) uniform int casterCount;
layout(location = 6) uniform int layersInAll;

shared int listed;

bool mightSee(mat4 clipFromLight, int caster) {
    // Outside one plane with all corners; depth has no far plane. A little slack covers rounding.
    bvec4 outside = bvec4(true);
    bool isBehind = true;
    for (int i = 0; i < 8; ++i) {
        vec4 p = clipFromLight * boxes[caster].corners[i];
        float edge = p.w + 1e-4 * abs(p.w);
        outside = bvec4(outside.x && p.x < -edge, outside.y && p.x > edge, outside.z && p.y < -edge,
                        outside.w && p.y > edge);
        isBehind = isBehind && p.z > edge;
    }
    return !any(outside) && !isBehind;
}

void main() {
    int caster = int(gl_WorkGroupID.x);
    int first = firstSlot();
    int layers = slotCount() * faces;
    int baseLayer = layerOf(first);
    if (gl_LocalInvocationIndex == 0u) listed = 0;
    barrier();

#ifdef LAYER_BY_LAYER
    int candidates = layersInAll;
#else
    int candidates = layers;
#endif
    for (int i = int(gl_LocalInvocationIndex); i < candidates; i += 64) {
#ifdef LAYER_BY_LAYER
        int layer = i;
        bool isUsed = layer >= baseLayer && layer < baseLayer + layers;
#else
        int layer = baseLayer + i;
        const bool isUsed = true;
#endif
        int slot = first + (layer - baseLayer) / faces;
        int camera = isUsed ? sampleOfSlot[slot] * faces + (layer - baseLayer) % faces : 0;
        if (caster == casterCount) {
            if (isUsed) {
                layerCameras[layer] = cameras[camera].camera;
                layerTaps[layer] = cameras[camera].tap;
            }
#ifdef LAYER_BY_LAYER
            commands[casterCount * layersInAll + layer] = DrawCommand(3, isUsed ? 1 : 0, 0, 0, 0);
#endif
        } else {
            uint indices = boxes[caster].draw.x;
            bool isSeen = isUsed && indices != 0u && mightSee(cameras[camera].camera.clipFromLight, caster);
#ifdef LAYER_BY_LAYER
            layerLists[caster * layersInAll + layer] = layer;
            commands[caster * layersInAll + layer] = DrawCommand(int(indices), isSeen ? 1 : 0, 0, 0, 0);
#else
            if (isSeen) layerLists[caster * layersInAll + atomicAdd(listed, 1)] = layer;
#endif
        }
    }
    barrier();
#ifndef LAYER_BY_LAYER
    if (gl_LocalInvocationIndex == 0u) {
        commands[caster] = caster == casterCount ? DrawCommand(3, layers, 0, 0, 0)
                                                 : DrawCommand(int(boxes[caster].draw.x), listed, 0, 0, 0);
    }
#endif
}
