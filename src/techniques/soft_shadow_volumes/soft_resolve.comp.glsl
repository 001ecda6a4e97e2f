// SPDX-License-Identifier: Apache-2.0
#version 450
// Visibility from the edges that matter to a tile (README.md, "Counting layers"), in rounds of bounded work: a tile that
// is not done keeps its counts and asks for another round ("Rounds").
//
// SAMPLES: see layer_counts.glsl; EDGES_AT_ONCE: how many edges a tile has room for, a multiple of 32.
layout(local_size_x = 8, local_size_y = 8) in;
#ifndef EDGES_AT_ONCE
#define EDGES_AT_ONCE 256
#endif

#include "src/techniques/common/view.glsl"
#include "src/techniques/soft_shadow_volumes/volumes_io.h"
#include "src/techniques/soft_shadow_volumes/lifted_receiver.glsl"
#include "src/techniques/soft_shadow_volumes/light_area.glsl"
#include "src/techniques/soft_shadow_volumes/light_points.glsl"
#include "src/techniques/soft_shadow_volumes/point_places.glsl"
#include "src/techniques/soft_shadow_volumes/seen_edges.glsl"
#include "src/techniques/soft_shadow_volumes/light_table.glsl"
#include "src/techniques/soft_shadow_volumes/radiance_beyond.glsl"
#include "src/techniques/soft_shadow_volumes/tile_shaft.glsl"
#include "src/techniques/soft_shadow_volumes/layer_counts.glsl"
#include "src/techniques/soft_shadow_volumes/layer_visibility.glsl"

layout(std430) readonly buffer Bounds { TileBounds bounds[]; };
layout(std430) readonly buffer LightEdges { LightEdge lightEdges[]; };
layout(std430) readonly buffer Eye { EyeState eye; };
layout(std430) readonly buffer Lists { uint lists[]; };
layout(std430) buffer States { int states[]; };
// The arguments of each round's indirect dispatch, then two lists of tiles: those of this round, and of the next.
layout(std430) buffer Rounds { uint rounds[]; };
uniform usampler2D centerCounts;
uniform usampler2DArray hiddenPoints;  // by casters with holes: a bit a point, in layers of 32
uniform writeonly image2D visibility;
layout(r32f) uniform writeonly image2D edgeCounts;
layout(r32f) uniform writeonly image2D shownCounts;

layout(std140) uniform Constants { ResolveConstants how; };

const uint stateWords = uint(SAMPLES) + 5u;
const uint wordsAtOnce = 64u;

shared uint mattering[EDGES_AT_ONCE];
shared uint matteringCount;
shared uint mostPoints;  // that an edge made a receiver look at

uint stateAt(uint tile, uint i) { return ((tile - how.firstTile) * (stateWords + 1u) + i) * 64u + gl_LocalInvocationIndex; }

void saveCounts(uint tile) {
    for (int i = 0; i < SAMPLES; ++i) states[stateAt(tile, uint(i))] = changes[i];
    uint rest = uint(SAMPLES);
    states[stateAt(tile, rest)] = leastChange;
    states[stateAt(tile, rest + 1u)] = edgesCounted;
    for (int i = 0; i < 3; ++i) states[stateAt(tile, rest + 2u + uint(i))] = meanChangeFixed[i];
}

void loadCounts(uint tile) {
    for (int i = 0; i < SAMPLES; ++i) changes[i] = states[stateAt(tile, uint(i))];
    uint rest = uint(SAMPLES);
    leastChange = states[stateAt(tile, rest)];
    edgesCounted = states[stateAt(tile, rest + 1u)];
    for (int i = 0; i < 3; ++i) meanChangeFixed[i] = states[stateAt(tile, rest + 2u + uint(i))];
}

void pause(uint tile, uint word) {
    saveCounts(tile);
    states[stateAt(tile, stateWords)] = int(word);
    if (gl_LocalInvocationIndex != 0u) return;
    uint next = 3u * (how.round + 1u);
    rounds[how.nextList + atomicAdd(rounds[next], 1u)] = tile;
    atomicMax(rounds[next + 1u], 1u);
    atomicMax(rounds[next + 2u], 1u);
}

// Of the edges that a word of the large tile's list names, those that matter to this tile.
uint matteringBits(uint list, uint word, uint words) {
    uint listed = word < words ? lists[list + word] : 0u;
    uint kept = 0u;
    for (uint bits = listed; bits != 0u; bits &= bits - 1u) {
        if (mayMatter(lightEdges[32u * word + uint(findLSB(bits))])) kept |= bits & (0u - bits);
    }
    return kept;
}

// Lists the edges named by each lane's word, and says how many there are: more than there is room for are counted, not
// listed.
uint listMattering(uint word, uint bits) {
    barrier();
    if (gl_LocalInvocationIndex == 0u) {
        matteringCount = 0u;
        mostPoints = 0u;
    }
    barrier();
    uint place = bits == 0u ? 0u : atomicAdd(matteringCount, uint(bitCount(bits)));
    for (; bits != 0u && place < uint(EDGES_AT_ONCE); bits &= bits - 1u) {
        mattering[place++] = 32u * word + uint(findLSB(bits));
    }
    barrier();
    return matteringCount;
}

// Whether no edge before it in the list, where those of many faces have their records side by side, lies where this one does
// and hides something, too.
bool isFirstThere(LightFrame frame, Receiver receiver, uint index) {
    if (index == 0u) return true;
    LightEdge edge = lightEdges[index], before = lightEdges[index - 1u];
    SeenEdge seen;
    return before.aLight != edge.aLight || before.bLight != edge.bLight || before.cutSide != edge.cutSide ||
           !hidesLight(frame, receiver, before, seen);
}

// Returns how many iterations no invocation has exceeded.
uint addMattering(LightFrame frame, Receiver receiver, bool seesLight, uint count) {
    SeenEdge edge;
    uint most = 0u;
    for (uint first = 0u; first < count && seesLight; first += 32u) {
        // Which of them hide something from this receiver, that those alone cost what an edge costs.
        uint bits = 0u;
        for (uint i = 0u; i < min(32u, count - first); ++i) {
            LightEdge listed = lightEdges[mattering[first + i]];
            bool isSeen = listed.isFace ? mayHide(frame, receiver, listed)
                                        : !frame.isInside && hidesLight(frame, receiver, listed, edge);
            if (isSeen) bits |= 1u << i;
        }
        for (; bits != 0u; bits &= bits - 1u) {
            uint index = mattering[first + uint(findLSB(bits))];
            LightEdge listed = lightEdges[index];
            if (listed.isFace) {
                most = max(most, addFace(frame, receiver, listed));
            } else {
                hidesLight(frame, receiver, listed, edge);
                most = max(most, addEdge(frame, edge, changeBeyond(frame, receiver, listed, edge),
                                          isFirstThere(frame, receiver, index)));
            }
        }
    }
    atomicMax(mostPoints, most);
    barrier();
    // Sixteen: an edge's own loops, the search for its first point and the clipping.
    return count * (mostPoints + 16u);
}

// Adds a layer before each point that a caster with holes hides.
void addHidden(ivec2 texel) {
    vec3 hidden = vec3(0.0), all = vec3(0.0);
    uint word = 0u, any = 0u;
    for (int i = 0; i < SAMPLES; ++i) {
        if ((i & 31) == 0) word = texelFetch(hiddenPoints, ivec3(texel, i >> 5), 0).r;
        bool isHidden = (word & (1u << (i & 31))) != 0u;
        vec3 radiance = volume.light.isTextured ? radiances[i].rgb : vec3(1.0);
        changes[i] += isHidden ? 1 : 0;
        hidden += isHidden ? radiance : vec3(0.0);
        all += radiance;
        any |= word;
    }
    if (any == 0u) return;
    meanChangeFixed += ivec3(hidden / max(all, 1e-30) * fixedOne);
    leastChange = 1;
    ++edgesCounted;
}

void main() {
    uint lane = gl_LocalInvocationIndex;
    uint tile = how.round == 0u ? how.firstTile + gl_WorkGroupID.y * volume.smallTilesAcross + gl_WorkGroupID.x
                             : rounds[how.thisList + gl_WorkGroupID.x];
    uvec2 place = uvec2(tile % volume.smallTilesAcross, tile / volume.smallTilesAcross);
    ivec2 texel = ivec2(8u * place + gl_LocalInvocationID.xy);
    bool isInside = all(lessThan(texel, volume.buffer_px));

    Receiver receiver;
    LightFrame frame;
    bool isReceiver = isInside && loadLiftedReceiver(texel, receiver);
    bool seesLight = isReceiver && makeLightFrame(receiver, frame) && horizonSide(frame) >= 0;
    if (seesLight) spreadPoints(frame);
    for (int i = 0; i < SAMPLES; ++i) changes[i] = 0;
    uint word = 0u;
    if (how.round > 0u) {
        loadCounts(tile);
        word = uint(states[stateAt(tile, stateWords)]);
    }

    TileBounds tileBounds = bounds[tile];
    prepareShaft(tileBounds, lightBounds(tileBounds));
    uvec2 largeTile = place / volume.smallTilesALargeOne;
    uint list = (largeTile.y * volume.largeTilesAcross + largeTile.x) * volume.listWords;
    bool isEmpty = tileBounds.low.x > tileBounds.high.x;
    uint words = isEmpty ? 0u : wordsOfEdges(eye.edgeCount);
    uint work = 0u;
    while (word < words && work < how.roundWork) {
        uint bits = matteringBits(list, word + lane, words);
        work += 32u;
        uint count = listMattering(word + lane, bits);
        if (count <= uint(EDGES_AT_ONCE)) {
            work += addMattering(frame, receiver, seesLight, count);
            word += wordsAtOnce;
        } else {
            // As many words at a time as there is room for.
            const uint fitting = uint(EDGES_AT_ONCE) / 32u;
            for (uint first = 0u; first < wordsAtOnce && work < how.roundWork; first += fitting) {
                uint part = listMattering(word - first + lane, lane / fitting == first / fitting ? bits : 0u);
                work += addMattering(frame, receiver, seesLight, part);
                word += fitting;
            }
        }
    }
    if (word < words) {
        pause(tile, word);
        return;
    }

    if (!isInside) return;
    vec3 seen = vec3(isReceiver ? 0.0 : 1.0);
    int atCenter = int(texelFetch(centerCounts, texel, 0).r);
    if (seesLight) {
        if (how.hasMasks) addHidden(texel);
        seen = visibilityOf(frame, atCenter);
    }
    imageStore(shownCounts, texel, vec4(float(atCenter)));
    imageStore(visibility, texel, vec4(seen, 1.0));
    imageStore(edgeCounts, texel, vec4(float(edgesCounted)));
}
