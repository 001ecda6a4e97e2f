// SPDX-License-Identifier: Apache-2.0
#version 450
// Where the picture's receivers are, tile by tile: what maps have to show, and whether anything has moved. A group a
// tile. Variants of sample_test.glsl, and BITS: only receivers that ask for samples that were not compared, and in which
// quads of level 3 these lie.
layout(local_size_x = 8, local_size_y = 8) in;

// What seems to lie on the horizon here may lie on either side of it in the evaluation's own arithmetic: it counts as
// undecided, so that no receiver is left out which the evaluation will ask for.
#define LEAST_HEIGHT 1e-5

#include "src/techniques/common/view.glsl"
#include "src/techniques/light_sampling/sample_test.glsl"
#include "src/techniques/light_sampling/value.glsl"

layout(std140) uniform Constants { ReceiverTilesConstants constants; };
layout(std430) buffer Tiles { ReceiverTile tiles[]; };

#ifdef BITS
#include "src/techniques/light_sampling/subdivision_io.h"
#include "src/techniques/light_sampling/lattice_bits.glsl"
uniform usampler2D shadowBits;
layout(std430) readonly buffer SubdivisionBlock { Subdivision subdivision; };
#include "src/techniques/light_sampling/settled.glsl"

// Then all samples count, without a look at each (but black texels do not).
bool isAllAboveHorizon(Receiver receiver) {
#if defined(COLORED)
    return false;
#elif defined(DISTANT)
    return receiver.normalLight.z > constants.lightRadius + LEAST_HEIGHT;
#else
    float distance = length(receiver.posLight) + constants.lightRadius;
    return dot(receiver.normalLight, -receiver.posLight) > constants.lightRadius + LEAST_HEIGHT * distance;
#endif
}
#else
layout(std430) buffer RedrawBlock { RedrawGroups redraw; };
#endif

shared uint low[3], high[3], quads[2];

// Of an invocation's own pixels.
struct Part {
    vec3 low, high;
    uvec2 quads;
};

#ifndef BITS
// Changes with any bit of the receiver (Jarzynski and Olano 2020, pcg).
uvec2 sumOf(ivec2 pixel, Receiver receiver) {
    uvec3 pos = floatBitsToUint(receiver.posLight), normal = floatBitsToUint(receiver.normalLight);
    uvec2 sum = uvec2(pixel);
    for (int i = 0; i < 3; ++i) {
        sum = (sum ^ uvec2(pos[i], normal[i])) * 1664525u + 1013904223u;
        sum += sum.yx * 1664525u;
        sum ^= sum >> 16u;
    }
    return sum;
}
#endif

void add(ivec2 pixel, inout Part part) {
    Receiver receiver;
    if (any(greaterThanEqual(pixel, view.size_px.xy)) || !loadReceiver(pixel, receiver)) return;
#ifndef BITS
    part.quads += sumOf(pixel, receiver);
#endif
    if (isBehindLight(receiver)) return;
#ifdef BITS
    Comparison comparison = loadComparison(pixel);
    if (isSettled(comparison, receiver)) return;
    comparison.counted = isAllAboveHorizon(receiver) ? comparison.tree : uvec4(0u);
    for (int word = 0; word < 3; ++word) {
        for (uint rest = comparison.tree[word] & ~comparison.counted[word]; rest != 0u; rest &= rest - 1u) {
            LightSample light = samples[vertexOf(word, findLSB(rest))];
            precise VALUE weight = countOf(light, receiver) * WEIGHT(light);
            if (weight != VALUE(0.0)) comparison.counted[word] |= rest & -rest;
        }
    }
    findUnsettled(comparison);
    bool isLevel4Left = false;
    for (int y = 0; y < 8; ++y) isLevel4Left = isLevel4Left || subdivision.deepestRows[y] != 0u;
    if (isLevel4Left && comparison.unsettled == uvec2(0u)) return;
    part.quads |= comparison.unsettled;
#endif
    vec3 pos = makeLookup(receiver).pos;
    part.low = min(part.low, pos);
    part.high = max(part.high, pos);
}

void main() {
#ifdef BITS
    if (plan.stages[stageOfDeepest].y == 0) return;  // nobody will ask
#endif
    if (gl_LocalInvocationIndex < 3u) {
        low[gl_LocalInvocationIndex] = 0xffffffffu;
        high[gl_LocalInvocationIndex] = 0u;
    }
    if (gl_LocalInvocationIndex < 2u) quads[gl_LocalInvocationIndex] = 0u;
    barrier();
    Part part = Part(vec3(3e38), vec3(-3e38), uvec2(0u));
    for (int y = 0; y < constants.tile_px; y += 8) {
        for (int x = 0; x < constants.tile_px; x += 8) {
            add(ivec2(gl_WorkGroupID.xy) * constants.tile_px + ivec2(x, y) + ivec2(gl_LocalInvocationID.xy), part);
        }
    }
    if (part.low.x <= part.high.x) {
        for (int i = 0; i < 3; ++i) {
            atomicMin(low[i], orderedBits(part.low[i]));
            atomicMax(high[i], orderedBits(part.high[i]));
        }
    }
    for (int i = 0; i < 2; ++i) {
#ifdef BITS
        if (part.quads[i] != 0u) atomicOr(quads[i], part.quads[i]);
#else
        if (part.quads[i] != 0u) atomicAdd(quads[i], part.quads[i]);
#endif
    }
    barrier();
    if (gl_LocalInvocationIndex != 0u) return;
    uint index = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    ReceiverTile tile;
    tile.low = uvec4(low[0], low[1], low[2], quads[0]);
    tile.high = uvec4(high[0], high[1], high[2], quads[1]);
#ifndef BITS
    if (tiles[index].low != tile.low || tiles[index].high != tile.high) {
        redraw.tiles.x = gl_NumWorkGroups.x;
        redraw.slots.x = uint(constants.slots);
        redraw.pixels.x = uint(constants.size_px.x + 7) / 8u;
    }
#endif
    tiles[index] = tile;
}
