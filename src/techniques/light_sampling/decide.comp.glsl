// SPDX-License-Identifier: Apache-2.0
#version 450
// Splits quads and gives the new corners slots (section 3.3.4), on the device: nothing waits. One group.
//
// A round draws and compares maps for all slots that are new, and then decides level after level as far as the corners
// of all quads are known. The first round starts with the vertices that the last frame's tree had up to level 3 (the
// future work of section 5), so that a tree which changes little is decided in one round. Decisions look at quads and
// their corners alone: which tree comes out does not depend on which vertices were at hand.
layout(local_size_x = 64) in;

#include "src/techniques/light_sampling/sampling_io.h"
#include "src/techniques/light_sampling/subdivision_io.h"
#include "src/techniques/light_sampling/lattice_bits.glsl"

layout(std430) buffer SubdivisionBlock { Subdivision subdivision; };
layout(std430) buffer Plan { SamplingPlan plan; };
layout(std430) buffer Slots { int sampleOfSlot[]; };
#include "src/techniques/light_sampling/subdivision.glsl"

layout(std140) uniform Constants { DecideConstants options; };

shared uint wish[64];
shared int ranked[64];
shared int slotOfVertex[latticeVertices];
shared bool isInTree[latticeVertices];
shared bool goesOn;

int vertexAt(ivec2 place) { return place.y * latticeSide + place.x; }

bool isCoarse(int vertex) { return (vertex % latticeSide) % 2 == 0 && (vertex / latticeSide) % 2 == 0; }

bool isBase(int vertex) {
    int step = 16 >> options.baseDepth;
    return (vertex % latticeSide) % step == 0 && (vertex / latticeSide) % step == 0;
}

bool isInLastTree(int vertex) {
    if (!options.isCoherent || !isCoarse(vertex)) return false;
    BitPlace place = bitPlace(vertex);
    return (subdivision.coarseVertices[place.word] & place.mask) != 0u;
}

void setGroups(bool any) {
    plan.compareGroups = any ? uvec4((options.target_px + 7) / 8, 1, 0) : uvec4(0u);
    plan.examineGroups = any ? uvec4((options.target_px + 15) / 16, 1, 0) : uvec4(0u);
}

void startTree() {
    bool compares = options.baseDepth < options.maxDepth;
    int slots = 0;
    uint coarse[3] = uint[3](0u, 0u, 0u);
    for (int vertex = 0; vertex < latticeVertices; ++vertex) {
        bool starts = isBase(vertex);
        if (starts && compares) {
            BitPlace place = bitPlace(vertex);
            coarse[place.word] |= place.mask;
        }
        subdivision.slotOfVertex[vertex] = -1;
        if (!starts && !isInLastTree(vertex)) continue;
        sampleOfSlot[slots] = vertex;
        subdivision.slotOfVertex[vertex] = slots++;
    }
    for (int i = 0; i < splittableQuads; ++i) {
        subdivision.failing[i] = 0u;
        subdivision.split[i] = i < quadIndex(options.baseDepth, ivec2(0)) ? 1u : 0u;
    }
    int before = 0;
    for (int level = 0; level <= deepestLevel; ++level) {
        int side = (1 << level) + 1;
        subdivision.samplesOfLevel[level] = level <= options.baseDepth ? uint(side * side - before) : 0u;
        before = side * side;
    }
    subdivision.coarseVertices = coarse;
    for (int y = 0; y < 8; ++y) subdivision.deepestRows[y] = options.baseDepth == deepestLevel ? 255u : 0u;
    subdivision.decidedLevels = options.baseDepth;
    subdivision.reachedMaximum = subdivision.errorBound = 0u;
    for (int i = 0; i < maxStages; ++i) plan.stages[i] = ivec4(slots, 0, 1, 1);
    plan.stages[stageOfAll] = plan.stages[compares ? 0 : stageOfDeepest] = ivec4(0, slots, 1, 1);
    if (compares) plan.stages[stageOfCoarse] = plan.stages[0];
    setGroups(true);
}

void main() {
    int index = int(gl_LocalInvocationIndex);
    if (options.round < 0) {
        if (index == 0) startTree();
        return;
    }
    int firstLevel = subdivision.decidedLevels;
    if (firstLevel == options.maxDepth) return;  // an earlier round has decided all
    for (int i = index; i < latticeVertices; i += 64) {
        slotOfVertex[i] = subdivision.slotOfVertex[i];
        BitPlace place = bitPlace(i);
        isInTree[i] = isCoarse(i) && (subdivision.coarseVertices[place.word] & place.mask) != 0u;
    }
    if (index == 0) goesOn = true;
    int first = plan.stages[stageOfAll].y;
    int slots = first;
    barrier();
    for (int level = firstLevel; level < options.maxDepth; ++level) {
        // Quads in the order of need: if samples run out, they went where most fragments fail.
        int side = 1 << level;
        bool isQuad = goesOn && index < side * side;
        ivec2 quad = ivec2(index % side, index / side);
        uint count = isQuad ? subdivision.failing[quadIndex(level, quad)] : 0u;
        bool wants = count > options.tolerated || level < options.minDepth;
        wish[index] = isQuad && quadExists(level, quad) && wants ? count + 1u : 0u;
        ranked[index] = -1;
        barrier();
        int rank = 0;
        for (int i = 0; i < 64; ++i) {
            rank += int(wish[i] > wish[index] || (wish[i] == wish[index] && i < index));
        }
        if (wish[index] > 0u) ranked[rank] = index;
        barrier();
        if (index == 0 && goesOn) {
            int used = 0;
            for (int i = 0; i <= deepestLevel; ++i) used += int(subdivision.samplesOfLevel[i]);
            int halfSide = 8 >> level;
            int slotsBefore = slots;
            for (int i = 0; i < 64 && ranked[i] >= 0; ++i) {
                ivec2 place = 2 * halfSide * ivec2(ranked[i] % side, ranked[i] / side);
                const ivec2 steps[5] = ivec2[5](ivec2(1, 0), ivec2(0, 1), ivec2(1, 1), ivec2(2, 1), ivec2(1, 2));
                int needed = 0;
                for (int j = 0; j < 5; ++j) needed += int(!isInTree[vertexAt(place + halfSide * steps[j])]);
                if (used + needed > options.maxSamples) {
                    subdivision.reachedMaximum = 1u;
                    continue;
                }
                subdivision.split[quadIndex(level, place / (2 * halfSide))] = 1u;
                if (level == 3) subdivision.deepestRows[place.y / 2] |= 1u << (place.x / 2);
                used += needed;
                subdivision.samplesOfLevel[level + 1] += uint(needed);
                for (int j = 0; j < 5; ++j) {
                    int vertex = vertexAt(place + halfSide * steps[j]);
                    if (isInTree[vertex]) continue;
                    isInTree[vertex] = true;
                    if (level + 1 < options.maxDepth) {  // else nothing compares it
                        BitPlace bit = bitPlace(vertex);
                        subdivision.coarseVertices[bit.word] |= bit.mask;
                    }
                    if (slotOfVertex[vertex] >= 0) continue;
                    slotOfVertex[vertex] = slots;
                    subdivision.slotOfVertex[vertex] = slots;
                    sampleOfSlot[slots++] = vertex;
                }
            }
            subdivision.decidedLevels = level + 1;
            goesOn = slots == slotsBefore && !options.isOneLevelARound;
        }
        memoryBarrierBuffer();
        barrier();
    }
    if (index == 0) {
        int decided = subdivision.decidedLevels;
        for (int i = quadIndex(decided, ivec2(0)); i < splittableQuads; ++i) subdivision.failing[i] = 0u;
        // What the last split brings is not compared.
        bool isDeepest = decided == options.maxDepth;
        plan.stages[isDeepest ? stageOfDeepest : options.round + 1] = ivec4(first, slots - first, 1, 1);
        plan.stages[stageOfAll] = ivec4(0, slots, 1, 1);
        if (!isDeepest) plan.stages[stageOfCoarse] = plan.stages[stageOfAll];
        setGroups(!isDeepest);
        if (decided < options.maxDepth || options.maxDepth == deepestLevel) subdivision.errorBound = 0u;  // told anew of the finer tree
    }
}
