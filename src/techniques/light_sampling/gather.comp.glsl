// SPDX-License-Identifier: Apache-2.0
#version 450
// Lists for each caster (a group each) the layers of the batch whose maps have to show it, and (the last group) the
// layers that have to show anything. Variant LAYER_BY_LAYER: a command a caster and layer instead of one a caster.
layout(local_size_x = 64) in;

#include "src/techniques/light_sampling/batch.glsl"

layout(std430) readonly buffer LayerCameras { LightCameraConstants layerCameras[]; };
layout(std430) readonly buffer Masks { LayerMask masks[]; };
layout(std430) readonly buffer Boxes { CullBox boxes[]; };
layout(std430) writeonly buffer Instances { ivec2 layerAndCaster[]; };
layout(std430) writeonly buffer Commands { DrawCommand commands[]; };
layout(std430) readonly buffer RedrawBlock { RedrawGroups redraw; };

layout(std140) uniform Constants { GatherConstants constants; };

shared int listed;

bool hasToShow(int layer, int caster) {
    mat4 clipFromLight = layerCameras[layer].clipFromLight, faceFromLight = layerCameras[layer].faceFromLight;
    // Outside one plane with all corners; depth has no far plane. A little slack covers rounding.
    bvec4 outside = bvec4(true);
    bool isBehind = true, isBefore = true;
    vec2 low = vec2(1e30), high = vec2(-1e30);
    float nearest = 3e38;
    for (int i = 0; i < 8; ++i) {
        vec4 p = clipFromLight * boxes[caster].corners[i];
        float edge = p.w + 1e-4 * abs(p.w);
        outside = bvec4(outside.x && p.x < -edge, outside.y && p.x > edge, outside.z && p.y < -edge,
                        outside.w && p.y > edge);
        isBehind = isBehind && p.z > edge;
        isBefore = isBefore && p.w > 0.0;
        low = min(low, p.xy / p.w);
        high = max(high, p.xy / p.w);
        float depth = (faceFromLight * boxes[caster].corners[i]).z;
        nearest = min(nearest, depth - 1e-4 * abs(depth));
    }
    if (any(outside) || isBehind) return false;
    if (!isBefore) {
        low = vec2(-1.0);
        high = vec2(1.0);
    }
    ivec4 cells = masks[layer].cells;
    ivec2 first = max(ivec2(floor((clamp(low - 1e-4, -1.0, 1.0) * 0.5 + 0.5) * float(maskSide))), cells.xy);
    ivec2 last = min(ivec2(floor((clamp(high + 1e-4, -1.0, 1.0) * 0.5 + 0.5) * float(maskSide))), cells.zw);
    uint depth = orderedBits(nearest);
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
            if (masks[layer].farthest[y * maskSide + x] >= depth) return true;
        }
    }
    return false;
}

// Clearing draws arrays, which have no base vertex: there the first instance is the fourth number.
DrawCommand command(bool isClear, int count, int instances, int firstInstance) {
    return DrawCommand(count, instances, 0, isClear ? firstInstance : 0, firstInstance);
}

void main() {
    int caster = int(gl_WorkGroupID.x);
    int baseLayer = layerOf(firstSlot());
    int layers = constants.isKept && redraw.slots.x == 0u ? 0 : slotCount() * batch.faces;
    bool isClear = caster == constants.casterCount;
    int indices = isClear ? 6 : int(boxes[caster].indexCount);
    int firstInstance = caster * constants.layersInAll;
    if (gl_LocalInvocationIndex == 0u) listed = 0;
    barrier();

#ifdef LAYER_BY_LAYER
    for (int layer = int(gl_LocalInvocationIndex); layer < constants.layersInAll; layer += 64) {
        bool isUsed = layer >= baseLayer && layer < baseLayer + layers;
#else
    for (int layer = baseLayer + int(gl_LocalInvocationIndex); layer < baseLayer + layers; layer += 64) {
        const bool isUsed = true;
#endif
        bool isShown = isUsed && indices != 0 && masks[layer].cells.z >= 0 && (isClear || hasToShow(layer, caster));
#ifdef LAYER_BY_LAYER
        layerAndCaster[firstInstance + layer] = ivec2(layer, caster);
        commands[firstInstance + layer] = command(isClear, indices, isShown ? 1 : 0, firstInstance + layer);
#else
        if (isShown) layerAndCaster[firstInstance + atomicAdd(listed, 1)] = ivec2(layer, caster);
#endif
    }
    barrier();
#ifndef LAYER_BY_LAYER
    if (gl_LocalInvocationIndex == 0u) commands[caster] = command(isClear, indices, listed, firstInstance);
#endif
}
