// SPDX-License-Identifier: Apache-2.0
#version 450
// Puts the batch's cameras in the order of its layers, and finds what each layer's map has to show: for each cell of the
// map the depth of the farthest receiver that will be looked up there. Casters elsewhere, or behind it, shadow nothing
// (J. Bittner, O. Mattausch, A. Silvennoinen, M. Wimmer, Shadow caster culling for efficient shadow mapping, 2011: a
// receiver mask, with depth). A group a slot.
layout(local_size_x = 256) in;

#include "src/techniques/light_sampling/batch.glsl"
#include "src/techniques/light_sampling/subdivision_io.h"

layout(std430) readonly buffer Slots { int sampleOfSlot[]; };
layout(std430) readonly buffer Cameras { SampleCamera cameras[]; };
layout(std430) readonly buffer Samples { LightSample samples[]; };
layout(std430) readonly buffer Tiles { ReceiverTile tiles[]; };
layout(std430) writeonly buffer LayerTaps { LayerTap layerTaps[]; };
layout(std430) writeonly buffer LayerCameras { LightCameraConstants layerCameras[]; };
layout(std430) writeonly buffer Masks { LayerMask masks[]; };

layout(std140) uniform Constants { PlaceLayersConstants needs; };

shared uint farthest[maskSide * maskSide];
shared uint alongRows[maskSide * maskSide];
shared uint farthestOfAll;
shared int rim[4];

const float beyond = 3e38;  // of every receiver

// Quads of level 3 that have the vertex on their rim or within, as ReceiverTile has them; all for a coarse one.
uvec2 quadsOf(int vertex) {
    ivec2 place = ivec2(vertex % latticeSide, vertex / latticeSide);
    if (!needs.asksByQuads || all(equal(place % 2, ivec2(0)))) return uvec2(0u);
    ivec2 low = max((place - 1) / 2, ivec2(0)), high = min(place / 2, ivec2(7));
    uvec2 quads = uvec2(0u);
    for (int y = low.y; y <= high.y; ++y) {
        for (int x = low.x; x <= high.x; ++x) quads[y / 4] |= 1u << (8 * (y % 4) + x);
    }
    return quads;
}

// How far from the receiver's own place the filter between samples looks (besideSampleLit), in the map's units. The line
// from the place beside the sample to the receiver passes a blocker's depth b, where the receiver's is z, at
// (step + (receiver - step) b / z) seen from the sample. That is off by (1 - b / z) (step.xy - tan step.z) / (the place's
// depth), which is largest for the nearest blocker and the farthest receiver that there are.
float reachInMap(LightSample light, SampleCamera camera, bool isOrthographic, float farthest_m) {
    if (needs.reach == 0.0) return 0.0;
    float most = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec2 at = needs.reach * vec2((i & 1) * 2 - 1, (i >> 1) * 2 - 1);
        vec3 along = at.x * light.spanU + at.y * light.spanV;
        if (isOrthographic) {
            vec3 beside = mat3(needs.face0FromLight) * (light.place + along);
            if (beside.z > -0.02) return beyond;
            float slope = length(beside.xy / beside.z - camera.tap.origin.xy);
            most = max(most, slope * max(farthest_m - needs.nearestBlocker_m, 0.0));
        } else {
            vec3 step = mat3(needs.face0FromLight) * along;
            float depth = needs.nearestBlocker_m - abs(step.z);
            if (!(depth > 0.0)) return beyond;
            vec2 window = max(abs(camera.tap.window.min), abs(camera.tap.window.min + 1.0 / camera.tap.window.perExtent));
            float tangent = (length(step.xy) + length(window) * abs(step.z)) / depth;
            most = max(most, tangent * max(1.0 - needs.nearestBlocker_m / farthest_m, 0.0));
        }
    }
    return most;
}

// Enters a tile's receivers, at their own places.
void addTile(ReceiverTile tile, SampleCamera camera, bool isOrthographic) {
    vec3 low, high;
    for (int i = 0; i < 3; ++i) {
        low[i] = fromOrderedBits(tile.low[i]);
        high[i] = fromOrderedBits(tile.high[i]);
    }
    vec2 windowMin = camera.tap.window.min, windowMax = windowMin + 1.0 / camera.tap.window.perExtent;
    vec2 from = windowMin, to = windowMax;
    if (isOrthographic) {
        vec2 a = camera.tap.origin.xy * low.z, b = camera.tap.origin.xy * high.z;
        from = low.xy - max(a, b);
        to = high.xy - min(a, b);
    } else {
        if (needs.isCube) {
            mat3 turn = mat3(camera.camera.faceFromLight);
            vec3 middle = turn * (0.5 * (low + high));
            vec3 extent = mat3(abs(turn[0]), abs(turn[1]), abs(turn[2])) * (0.5 * (high - low));
            low = middle - extent;
            high = middle + extent;
        }
        low -= camera.tap.origin;
        high -= camera.tap.origin;
        // None of it in the pyramid that the map shows.
        float foremost = max(low.z, 0.0);
        if (high.z <= 0.0 || any(lessThan(high.xy, min(windowMin * high.z, windowMin * foremost))) ||
            any(greaterThan(low.xy, max(windowMax * high.z, windowMax * foremost)))) return;
        if (low.z > 1e-3 * high.z) {
            from = min(low.xy / low.z, low.xy / high.z);
            to = max(high.xy / low.z, high.xy / high.z);
        }
    }
    // Two texels make up for rounding and for kernels of three.
    float slack = 2.0 / float(needs.mapSize_px);
    vec2 uvMin = (from - windowMin) * camera.tap.window.perExtent - slack, uvMax = (to - windowMin) * camera.tap.window.perExtent + slack;
    if (any(lessThan(uvMax, vec2(0.0))) || any(greaterThan(uvMin, vec2(1.0)))) return;
    ivec2 first = ivec2(floor(clamp(uvMin, 0.0, 1.0) * float(maskSide)));
    ivec2 last = min(ivec2(floor(clamp(uvMax, 0.0, 1.0) * float(maskSide))), maskSide - 1);
    uint depth = orderedBits(high.z);
    atomicMax(farthestOfAll, depth);
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) atomicMax(farthest[y * maskSide + x], depth);
    }
    atomicMin(rim[0], first.x);
    atomicMin(rim[1], first.y);
    atomicMax(rim[2], last.x);
    atomicMax(rim[3], last.y);
}

void placeLayer(int layer, int vertex, SampleCamera camera) {
    int index = int(gl_LocalInvocationIndex);
    bool isOrthographic = camera.camera.depth.isOrthographic;
    bool showsAll = needs.tileCount < 0;
    for (int i = index; i < maskSide * maskSide; i += 256) farthest[i] = showsAll ? orderedBits(beyond) : 0u;
    if (index == 0) {
        layerCameras[layer] = camera.camera;
        layerTaps[layer] = camera.tap;
        farthestOfAll = 0u;
        rim = showsAll ? int[4](0, 0, maskSide - 1, maskSide - 1) : int[4](maskSide, maskSide, -1, -1);
    }
    barrier();
    uvec2 quads = quadsOf(vertex);
    for (int i = index; i < needs.tileCount; i += 256) {
        ReceiverTile tile = tiles[i];
        if (tile.low.x > tile.high.x) continue;
        if (quads != uvec2(0u) && ((quads.x & tile.low.w) | (quads.y & tile.high.w)) == 0u) continue;
        addTile(tile, camera, isOrthographic);
    }
    barrier();
    // What is asked for from beside: farther than its own place by some cells.
    ivec2 around = ivec2(0);
    if (rim[2] >= 0 && farthestOfAll != 0u) {
        float most = reachInMap(samples[vertex], camera, isOrthographic, fromOrderedBits(farthestOfAll));
        around = ivec2(ceil(min(most * camera.tap.window.perExtent, 1.0) * float(maskSide)));
    }
    for (int i = index; i < maskSide * maskSide; i += 256) {
        int x = i % maskSide;
        uint depth = 0u;
        for (int j = max(x - around.x, 0); j <= min(x + around.x, maskSide - 1); ++j) {
            depth = max(depth, farthest[i - x + j]);
        }
        alongRows[i] = depth;
    }
    barrier();
    for (int i = index; i < maskSide * maskSide; i += 256) {
        int x = i % maskSide, y = i / maskSide;
        uint depth = 0u;
        for (int j = max(y - around.y, 0); j <= min(y + around.y, maskSide - 1); ++j) {
            depth = max(depth, alongRows[j * maskSide + x]);
        }
        masks[layer].farthest[i] = depth;
    }
    if (index != 0) return;
    ivec4 cells = ivec4(rim[0], rim[1], rim[2], rim[3]);
    if (cells.z >= 0) cells = clamp(cells + ivec4(-around, around), 0, maskSide - 1);
    masks[layer].cells = cells;
}

void main() {
    if (int(gl_WorkGroupID.x) >= slotCount()) return;
    int slot = firstSlot() + int(gl_WorkGroupID.x);
    int vertex = sampleOfSlot[slot];
    for (int face = 0; face < batch.faces; ++face) {
        placeLayer(layerOf(slot) + face, vertex, cameras[vertex * batch.faces + face]);
        barrier();
    }
}
