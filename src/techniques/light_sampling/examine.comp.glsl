// SPDX-License-Identifier: Apache-2.0
#version 450
// Counts, for every quad whose corners are known and that is not decided yet, the fragments that fail the test. Atomic
// counters take the place of the paper's occlusion queries: one pass instead of one query a quad, and the device reads
// the counts itself.
layout(local_size_x = 16, local_size_y = 16) in;

#include "src/techniques/light_sampling/subdivision_io.h"
#include "src/techniques/light_sampling/lattice_bits.glsl"

uniform usampler2D shadowBits;
layout(std430) buffer SubdivisionBlock { Subdivision subdivision; };
#include "src/techniques/light_sampling/examine.glsl"
#include "src/techniques/light_sampling/subdivision.glsl"

layout(std140) uniform Constants { ExamineConstants options; };

shared uint failing[splittableQuads];
shared uint known[15];   // quads to count for: level l's rows from 2^l - 1 on, bit x: left edge in column x
shared uint leaves[15];  // quads that are not split so far; << 16: of level 3, those that are
shared uint largestError;

// How wrong the sum may be: a quad whose corners disagree is lit in an unknown part of its area a, and what the corners
// say of it is off by a times `cellError` in the root mean square. However the errors of quads depend on each other,
// that of their sum is no more than the sum of theirs (Minkowski). Quads of the deepest level are not compared; an edge
// that crosses a quad crosses three of its quarters at most, so that is what a quad split into them counts as.
float errorOf(uvec4 bits) {
    float error = 0.0;
    for (int l = 0; l <= min(subdivision.decidedLevels, 3); ++l) {
        int mixed = 0, quartered = 0;
        for (int y = 0; y < (1 << l); ++y) {
            uint penumbra = penumbraOf(sumsOfRow(bits, y * (8 >> l), 8 >> l));
            uint counts = leaves[(1 << l) - 1 + y];
            mixed += bitCount(penumbra & counts & 0xffffu);
            quartered += bitCount(penumbra & (counts >> 16));
        }
        error += (float(mixed) + 0.75 * float(quartered)) / float(1 << (2 * l));
    }
    return options.cellError * error;
}

bool isKnown(ivec2 place) { return subdivision.slotOfVertex[place.y * latticeSide + place.x] >= 0; }

bool areCornersKnown(int level, ivec2 quad) {
    int side = 16 >> level;
    ivec2 low = quad * side;
    return isKnown(low) && isKnown(low + ivec2(side, 0)) && isKnown(low + ivec2(0, side)) && isKnown(low + side);
}

void listQuads(int index, int decided) {
    int level = findMSB(uint(index) + 1u);
    uint knownRow = 0u, leafRow = 0u;
    for (int x = 0; x < (1 << level); ++x) {
        ivec2 quad = ivec2(x, index - (1 << level) + 1);
        uint bit = 1u << (x * (8 >> level));
        if (level >= decided && level < options.maxDepth && areCornersKnown(level, quad)) knownRow |= bit;
        if (level > decided || !quadExists(level, quad)) continue;
        bool isSplit = subdivision.split[quadIndex(level, quad)] != 0u;
        if (!isSplit) leafRow |= bit;
        if (isSplit && level == 3) leafRow |= bit << 16;
    }
    known[index] = knownRow;
    leaves[index] = leafRow;
}

void main() {
    int decided = subdivision.decidedLevels;
    uint index = gl_LocalInvocationIndex;
    if (index < uint(splittableQuads)) failing[index] = 0u;
    if (index == 0u) largestError = 0u;
    if (index < 15u) listQuads(int(index), decided);
    barrier();

    ivec2 size_px = textureSize(shadowBits, 0);
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    uvec4 bits = all(lessThan(texel, size_px)) ? texelFetch(shadowBits, texel, 0) : uvec4(0u);
    if ((bits.x | bits.y | bits.z) != 0u) {
        bool wantsAll = false;
        if (options.maxError > 0.0) {
            float error = errorOf(bits);
            wantsAll = error > options.maxError;
            atomicMax(largestError, floatBitsToUint(error));
        }
        uvec4 ring[9];
        for (int i = 0; i < 9; ++i) {
            ring[i] = texelFetch(shadowBits, clamp(texel + ivec2(i % 3, i / 3) - 1, ivec2(0), size_px - 1), 0);
        }
        for (int level = decided; level < options.maxDepth; ++level) {
            int stride = 8 >> level, side = 1 << level;
            for (int y = 0; y < side; ++y) {
                uint counts = known[side - 1 + y];
                if (counts == 0u) continue;
                uint fails = wantsAll         ? penumbraOf(sumsOfRow(bits, y * stride, stride))
                             : options.maxError > 0.0 ? 0u
                                              : failingInRow(ring, y * stride, stride);
                fails &= counts;
                while (fails != 0u) {
                    atomicAdd(failing[quadIndex(level, ivec2(findLSB(fails) / stride, y))], 1u);
                    fails &= fails - 1u;
                }
            }
        }
    }
    barrier();
    if (index < uint(splittableQuads) && failing[index] > 0u) {
        atomicAdd(subdivision.failing[index], failing[index]);
    }
    if (index == 0u) atomicMax(subdivision.errorBound, largestError);
}
