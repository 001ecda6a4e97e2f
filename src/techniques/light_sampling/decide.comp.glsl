// SPDX-License-Identifier: Apache-2.0
#version 450
// Splits quads and gives the new corners slots (section 3.3.4), for a whole level, on the device: nothing waits.
// One group. Level -1 starts the tree with its four corners.
layout(local_size_x = 64) in;

#include "src/techniques/light_sampling/sampling_io.h"
#include "src/techniques/light_sampling/subdivision_io.h"

layout(std430, binding = 0) buffer SubdivisionBlock { Subdivision subdivision; };
layout(std430, binding = 1) buffer Plan { SamplingPlan plan; };
layout(std430, binding = 2) buffer Slots { int sampleOfSlot[]; };
#include "src/techniques/light_sampling/subdivision.glsl"

layout(location = 0) uniform int level;
layout(location = 1) uniform int maxSamples;
layout(location = 2) uniform uint tolerated;  // failing fragments
layout(location = 3) uniform int minDepth;    // every quad above it is split

shared uint wish[64];
shared int ranked[64];
shared int slotOfVertex[latticeVertices];

int vertexAt(ivec2 place) { return place.y * latticeSide + place.x; }

void main() {
    int index = int(gl_LocalInvocationIndex);
    if (level < 0) {
        for (int i = index; i < latticeVertices; i += 64) subdivision.slotOfVertex[i] = -1;
        for (int i = index; i < splittableQuads; i += 64) {
            subdivision.failing[i] = 0u;
            subdivision.split[i] = 0u;
        }
        barrier();
        memoryBarrierBuffer();
        if (index == 0) {
            for (int corner = 0; corner < 4; ++corner) {
                int vertex = vertexAt(16 * ivec2(corner & 1, corner >> 1));
                sampleOfSlot[corner] = vertex;
                subdivision.slotOfVertex[vertex] = corner;
            }
            for (int i = 0; i < maxStages; ++i) plan.stages[i] = ivec4(4, 0, 0, 0);
            plan.stages[0] = plan.stages[stageOfAll] = ivec4(0, 4, 0, 0);
            subdivision.reachedMaximum = 0u;
            subdivision.errorEstimate = subdivision.errorBound = 0u;
        }
        return;
    }

    // Quads in the order of need: if samples run out, they went where most fragments fail.
    int side = 1 << level;
    bool isQuad = index < side * side;
    ivec2 quad = ivec2(index % side, index / side);
    uint count = isQuad ? subdivision.failing[quadIndex(level, quad)] : 0u;
    bool wants = count > tolerated || level < minDepth;
    wish[index] = isQuad && quadExists(level, quad) && wants ? count + 1u : 0u;
    ranked[index] = -1;
    for (int i = index; i < latticeVertices; i += 64) slotOfVertex[i] = subdivision.slotOfVertex[i];
    barrier();
    int rank = 0;
    for (int i = 0; i < 64; ++i) {
        rank += int(wish[i] > wish[index] || (wish[i] == wish[index] && i < index));
    }
    if (wish[index] > 0u) ranked[rank] = index;
    barrier();
    if (index != 0) return;

    int first = plan.stages[stageOfAll].y;
    int slots = first;
    int halfSide = 8 >> level;
    for (int i = 0; i < 64 && ranked[i] >= 0; ++i) {
        quad = ivec2(ranked[i] % side, ranked[i] / side);
        const ivec2 steps[5] = ivec2[5](ivec2(1, 0), ivec2(0, 1), ivec2(1, 1), ivec2(2, 1), ivec2(1, 2));
        int needed = 0;
        for (int j = 0; j < 5; ++j) {
            needed += int(slotOfVertex[vertexAt(2 * halfSide * quad + halfSide * steps[j])] < 0);
        }
        if (slots + needed > maxSamples) {
            subdivision.reachedMaximum = 1u;
            continue;
        }
        subdivision.split[quadIndex(level, quad)] = 1u;
        for (int j = 0; j < 5; ++j) {
            int vertex = vertexAt(2 * halfSide * quad + halfSide * steps[j]);
            if (slotOfVertex[vertex] >= 0) continue;
            slotOfVertex[vertex] = slots;
            subdivision.slotOfVertex[vertex] = slots;
            sampleOfSlot[slots++] = vertex;
        }
    }
    plan.stages[level + 1] = ivec4(first, slots - first, 0, 0);
    for (int i = level + 2; i < stageOfAll; ++i) plan.stages[i] = ivec4(slots, 0, 0, 0);
    plan.stages[stageOfAll] = ivec4(0, slots, 0, 0);
    subdivision.errorEstimate = subdivision.errorBound = 0u;
}
