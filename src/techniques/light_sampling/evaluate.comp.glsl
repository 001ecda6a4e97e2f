// SPDX-License-Identifier: Apache-2.0
#version 450
// Sums what the receivers see of a batch's samples (equation 2, with weights). Variants of sample_test.glsl, and
// COLORED, where the light is textured; PARTIAL, where the sum takes several passes; BITS, where the comparison left the
// shadow values of coarse samples, and those of the deepest level are looked up only where the corners of their quads
// disagree; SMOOTH, where samples that disagree are asked for their cells; KEPT, where the answer is kept for frames in
// which nothing changes.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/common/view.glsl"
#include "src/techniques/light_sampling/sample_test.glsl"
#include "src/techniques/light_sampling/value.glsl"

uniform writeonly image2D visibility;
#ifdef KEPT
layout(FORMAT) uniform writeonly image2D kept;
#endif
#ifdef PARTIAL
layout(FORMAT) uniform image2D seenSoFar;
layout(FORMAT) uniform image2D wholeSoFar;
#endif

#ifdef BITS
#include "src/techniques/light_sampling/subdivision_io.h"
#include "src/techniques/light_sampling/lattice_bits.glsl"
uniform usampler2D shadowBits;
layout(std430) readonly buffer SubdivisionBlock { Subdivision subdivision; };
#endif

layout(std430) readonly buffer Order { int slotInOrder[]; };

layout(std140) uniform Constants { EvaluateConstants constants; };

#ifdef BITS
#include "src/techniques/light_sampling/settled.glsl"
#endif
#ifdef SMOOTH
#include "src/techniques/light_sampling/smooth.glsl"
#endif

void answer(ivec2 pixel, vec4 seen) {
    imageStore(visibility, pixel, seen);
#ifdef KEPT
    imageStore(kept, pixel, seen);
#endif
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, view.size_px.xy))) return;
    bool isInOrder = batch.isResident && batch.stage == stageOfAll;
#ifdef PARTIAL
    // How many slots there are the device alone may know: what comes after the last of them has nothing left to do.
    int slotsInAll = isInOrder ? plan.evaluated.x : plan.stages[batch.stage].y;
    int slotsBefore = batch.index * slotsInBatch();
    if (slotsBefore + constants.firstSlot >= max(slotsInAll, 1)) return;
    bool starts = slotsBefore + constants.firstSlot == 0;
    bool ends = slotsBefore + min(constants.endSlot, slotsInBatch()) >= slotsInAll;
#else
    const bool starts = true, ends = true;
#endif
    Receiver receiver;
    if (!loadReceiver(pixel, receiver)) {
        if (ends) answer(pixel, vec4(1.0));
        return;
    }
    VALUE seen = VALUE(0.0), whole = VALUE(0.0);
#ifdef PARTIAL
    if (!starts) {
        seen = FROM(imageLoad(seenSoFar, pixel));
        whole = FROM(imageLoad(wholeSoFar, pixel));
    }
#endif
    if (!isBehindLight(receiver)) {
        Lookup lookup = makeLookup(receiver);
#ifdef BITS
        Comparison comparison = loadComparison(pixel);
        if (isSettled(comparison, receiver)) {
            if (ends) answer(pixel, vec4(isAnyShadowed(comparison) ? 0.0 : 1.0));
            return;
        }
        comparison.counted = uvec4(0u);
        for (int word = 0; word < 3; ++word) {
            for (uint rest = comparison.tree[word]; rest != 0u; rest &= rest - 1u) {
                int vertex = vertexOf(word, findLSB(rest));
                precise VALUE weight = countOf(samples[vertex], receiver) * WEIGHT(samples[vertex]);
                if (weight == VALUE(0.0)) continue;
                uint mask = rest & -rest;
                comparison.counted[word] |= mask;
                if (!starts) continue;
                whole += weight;
                if ((comparison.shadows[word] & mask) == 0u) seen += weight;
            }
        }
        findUnsettled(comparison);
#ifdef SMOOTH
        findBorder(comparison);
        float nearness = meanNearness(comparison, lookup);
        for (int word = 0; word < 3 && nearness > 0.0 && starts; ++word) {
            for (uint rest = comparison.border[word]; rest != 0u; rest &= rest - 1u) {
                int vertex = vertexOf(word, findLSB(rest));
                VALUE weight = countOf(samples[vertex], receiver) * WEIGHT(samples[vertex]);
                float before = (comparison.shadows[word] & rest & -rest) == 0u ? 1.0 : 0.0;
                seen += weight * (cellLit(vertex, lookup, nearness) - before);
            }
        }
#endif
#endif
        int first = firstSlot();
        int end = min(isInOrder ? plan.evaluated.x : slotCount(), constants.endSlot);
        for (int i = constants.firstSlot; i < end; ++i) {
            int slot = isInOrder ? slotInOrder[i] : first + i;
            int vertex = sampleOfSlot[slot];
            float count = countOf(samples[vertex], receiver);
            if (count == 0.0) continue;
            precise VALUE weight = count * WEIGHT(samples[vertex]);
            whole += weight;
#ifdef BITS
            bool isLit;
            if (isAgreed(comparison, vertex, isLit)) {
                if (isLit) seen += weight;
                continue;
            }
#endif
#ifdef SMOOTH
            if (nearness > 0.0) {
                seen += weight * cellLit(vertex, lookup, nearness);
                continue;
            }
#endif
            seen += weight * (batch.faces > 0 ? sampleLit(layerOf(slot), lookup) : 1.0);
        }
    }
#ifdef PARTIAL
    if (!ends) {
        imageStore(seenSoFar, pixel, TO(seen));
        imageStore(wholeSoFar, pixel, TO(whole));
        return;
    }
#endif
    // Everything seen sums up the same addends as everything there is: the quotient is 1 exactly.
#ifdef COLORED
    vec3 quotient = vec3(whole.r > 0.0 ? seen.r / whole.r : 0.0, whole.g > 0.0 ? seen.g / whole.g : 0.0,
                         whole.b > 0.0 ? seen.b / whole.b : 0.0);
#else
    float quotient = whole > 0.0 ? seen / whole : 0.0;
#endif
    answer(pixel, TO(clamp(quotient, VALUE(0.0), VALUE(1.0))));
}
