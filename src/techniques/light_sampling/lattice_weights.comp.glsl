// SPDX-License-Identifier: Apache-2.0
#version 450
// What each sample of the subdivision stands for.
layout(local_size_x = 64) in;

#include "src/techniques/light_sampling/sampling_io.h"
#include "src/techniques/light_sampling/subdivision_io.h"

layout(std430, binding = 0) readonly buffer SubdivisionBlock { Subdivision subdivision; };
layout(std430, binding = 1) buffer Samples { LightSample samples[]; };
// A textured light's radiance over 34 x 34 cells, in `weight.rgb`: a quarter of what each vertex stands for at most.
layout(std430, binding = 2) readonly buffer Cells { LightSample cells[]; };
#include "src/techniques/light_sampling/subdivision.glsl"

layout(location = 0) uniform bool usesPaperWeights;
layout(location = 1) uniform bool isTextured;

vec3 radianceOf(ivec2 low, ivec2 high) {
    vec3 sum = vec3(0.0);
    for (int y = low.y; y < high.y; ++y) {
        for (int x = low.x; x < high.x; ++x) sum += cells[y * 34 + x].weight.rgb;
    }
    return sum;
}

void main() {
    int vertex = int(gl_GlobalInvocationID.x);
    if (vertex >= latticeVertices) return;
    ivec2 place = ivec2(vertex % latticeSide, vertex / latticeSide);

    // The integral over a leaf is its area times the mean of its corners, as for a bilinear function: each corner
    // stands for the quarter of the leaf next to it, and on the lattice's rim for the margin beyond (vertices are the
    // middles of 17 x 17 cells). Thus an even subdivision weighs all samples alike. A sample in the middle of a larger
    // neighbour's edge counts in its own leaves alone.
    float area = 0.0;
    vec3 radiance = vec3(0.0);
    int deepest = 0;
    for (int level = 0; level <= deepestLevel; ++level) {
        int side = 16 >> level;
        if (any(notEqual(place % side, ivec2(0)))) continue;
        for (int i = 0; i < 4; ++i) {
            ivec2 corner = ivec2(i & 1, i >> 1);
            ivec2 quad = place / side - corner;
            if (any(lessThan(quad, ivec2(0))) || any(greaterThanEqual(quad, ivec2(1 << level)))) continue;
            if (!isLeaf(level, quad)) continue;
            deepest = level;
            ivec2 low = 2 * place + 1 - corner * side;
            ivec2 high = low + side;
            low = mix(low, ivec2(0), equal(low, ivec2(1)));
            high = mix(high, ivec2(34), equal(high, ivec2(33)));
            area += float((high.x - low.x) * (high.y - low.y)) / (34.0 * 34.0);
            if (isTextured) radiance += radianceOf(low, high);
        }
    }
    // Equation 3, its depth being that of the finest quad at the sample: so the weights of an even subdivision add up
    // to 1, as the paper says they do.
    if (usesPaperWeights && area > 0.0) {
        float paper = 1.0 / float(((1 << deepest) + 1) * ((1 << deepest) + 1));
        radiance *= paper / area;
        area = paper;
    }
    samples[vertex].weight = vec4(radiance, area);
}
