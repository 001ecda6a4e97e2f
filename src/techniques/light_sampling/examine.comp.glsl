// SPDX-License-Identifier: Apache-2.0
#version 450
// Counts, for every quad of a level at once, the fragments that fail the test. Atomic counters take the place of the
// paper's occlusion queries: one pass instead of one query a quad, and the device reads the counts itself.
layout(local_size_x = 16, local_size_y = 16) in;

#include "src/techniques/light_sampling/subdivision_io.h"
#include "src/techniques/light_sampling/lattice_bits.glsl"

layout(binding = 0) uniform usampler2D shadowBits;
layout(std430, binding = 0) buffer SubdivisionBlock { Subdivision subdivision; };
#include "src/techniques/light_sampling/examine.glsl"
#include "src/techniques/light_sampling/subdivision.glsl"

layout(location = 0) uniform int level;       // examined; deepestLevel: only the error is wanted
layout(location = 1) uniform float maxError;  // 0: the paper's test decides

shared uint failing[64];
shared uint rows[15];  // quads that count for the error: level l's from 2^l - 1 on
shared uint largestEstimate, largestBound;

// How wrong the sum may be: a quad whose corners disagree is lit in an unknown part of its area a. The mean of its
// corners is off by 3/4 a at most: the bound. Parts spread evenly between nothing and all deviate by a / sqrt(12),
// independently of each other: the estimate. Quads of the deepest level are not compared; an edge that crosses a quad
// crosses three of its quarters at most, so that is what a quad split into them counts as.
struct Error {
    float variance, bound;
};

Error errorOf(uvec4 bits) {
    Error error = Error(0.0, 0.0);
    for (int l = 0; l <= min(level, 3); ++l) {
        int mixed = 0, quartered = 0;
        for (int y = 0; y < (1 << l); ++y) {
            uint penumbra = penumbraOf(sumsOfRow(bits, y * (8 >> l), 8 >> l));
            uint counts = rows[(1 << l) - 1 + y];
            mixed += bitCount(penumbra & counts & 0xffffu);
            quartered += bitCount(penumbra & (counts >> 16));
        }
        float area = 1.0 / float(1 << (2 * l));
        error.variance += area * area / 12.0 * (float(mixed) + 3.0 / 16.0 * float(quartered));
        error.bound += 0.75 * area * (float(mixed) + 0.75 * float(quartered));
    }
    return error;
}

void main() {
    int side = 1 << level;
    int stride = 8 >> level;
    uint index = gl_LocalInvocationIndex;
    if (index < 64u) failing[index] = 0u;
    if (index == 0u) largestEstimate = largestBound = 0u;
    if (index < 15u) {
        int l = findMSB(index + 1u);
        int y = int(index) - (1 << l) + 1;
        uint row = 0u;
        for (int x = 0; x < (1 << l); ++x) {
            ivec2 quad = ivec2(x, y);
            bool exists = l <= level && quadExists(l, quad);
            bool isSplit = exists && l < level && subdivision.split[quadIndex(l, quad)] != 0u;
            uint bit = 1u << (x * (8 >> l));
            if (exists && !isSplit) row |= bit;
            if (isSplit && l == 3) row |= bit << 16;
        }
        rows[index] = row;
    }
    barrier();

    ivec2 size_px = textureSize(shadowBits, 0);
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    uvec4 bits = all(lessThan(texel, size_px)) ? texelFetch(shadowBits, texel, 0) : uvec4(0u);
    if ((bits.x | bits.y | bits.z) != 0u) {
        bool wantsAll = false;
        if (maxError > 0.0) {
            Error error = errorOf(bits);
            float estimate = sqrt(error.variance);
            wantsAll = estimate > maxError;
            atomicMax(largestEstimate, floatBitsToUint(estimate));
            atomicMax(largestBound, floatBitsToUint(error.bound));
        }
        uvec4 ring[9];
        for (int i = 0; i < 9; ++i) {
            ring[i] = texelFetch(shadowBits, clamp(texel + ivec2(i % 3, i / 3) - 1, ivec2(0), size_px - 1), 0);
        }
        for (int y = 0; y < side && level < deepestLevel; ++y) {
            uint fails = wantsAll         ? penumbraOf(sumsOfRow(bits, y * stride, stride))
                         : maxError > 0.0 ? 0u
                                          : failingInRow(ring, y * stride, stride);
            fails &= rows[side - 1 + y];
            while (fails != 0u) {
                atomicAdd(failing[y * side + findLSB(fails) / stride], 1u);
                fails &= fails - 1u;
            }
        }
    }
    barrier();
    if (level < deepestLevel && index < uint(side * side) && failing[index] > 0u) {
        atomicAdd(subdivision.failing[quadIndex(level, ivec2(int(index) % side, int(index) / side))], failing[index]);
    }
    if (index == 0u) {
        atomicMax(subdivision.errorEstimate, largestEstimate);
        atomicMax(subdivision.errorBound, largestBound);
    }
}
