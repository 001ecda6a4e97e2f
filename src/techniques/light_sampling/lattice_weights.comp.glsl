// SPDX-License-Identifier: Apache-2.0
#version 450
// What each sample of the subdivision stands for, and the order in which they are summed up. One group.
layout(local_size_x = 320) in;

#include "src/techniques/light_sampling/sampling_io.h"
#include "src/techniques/light_sampling/subdivision_io.h"

layout(std430) buffer SubdivisionBlock { Subdivision subdivision; };
layout(std430) buffer Samples { LightSample samples[]; };
// A textured light's radiance over cells of the square, in `radianceShare`: a quarter of what each vertex stands for at most.
layout(std430) readonly buffer Cells { LightSample cells[]; };
#include "src/techniques/light_sampling/subdivision.glsl"

layout(std430) writeonly buffer Order { int slotInOrder[]; };
layout(std430) buffer Plan { SamplingPlan plan; };

layout(std140) uniform Constants { LatticeWeightsConstants constants; };

shared bool isUsed[latticeVertices];

vec3 radianceOf(ivec2 low, ivec2 high) {
    vec3 sum = vec3(0.0);
    for (int y = low.y; y < high.y; ++y) {
        for (int x = low.x; x < high.x; ++x) sum += cells[y * constants.cellsPerSide + x].radianceShare;
    }
    return sum;
}

// What a sample stands for.
struct Cell {
    vec3 radianceShare;
    float areaShare;  // 0 where the tree has no vertex
    vec2 middle;  // from the sample, in units of the square's sides
};

Cell cellOf(int vertex) {
    ivec2 place = ivec2(vertex % latticeSide, vertex / latticeSide);
    int cellsPerSide = constants.cellsPerSide, margin = (cellsPerSide - 2 * (latticeSide - 1)) / 2;

    // The integral over a leaf is its area times the mean of its corners, as for a bilinear function: each corner
    // stands for the quarter of the leaf next to it, and on the lattice's rim for the margin beyond (where vertices are
    // the middles of 17 x 17 cells). Thus an even subdivision weighs all samples alike. A sample in the middle of a larger
    // neighbour's edge counts in its own leaves alone.
    float area = 0.0;
    vec3 radiance = vec3(0.0);
    vec2 moment = vec2(0.0);
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
            ivec2 low = 2 * place + margin - corner * side;
            ivec2 high = low + side;
            low = mix(low, ivec2(0), equal(low, ivec2(margin)));
            high = mix(high, ivec2(cellsPerSide), equal(high, ivec2(cellsPerSide - margin)));
            float part = float((high.x - low.x) * (high.y - low.y)) / float(cellsPerSide * cellsPerSide);
            area += part;
            moment += part * (0.5 * vec2(low + high) - vec2(2 * place + margin)) / float(cellsPerSide);
            if (constants.isTextured) radiance += radianceOf(low, high);
        }
    }
    // Equation 3, its depth being that of the finest quad at the sample: so the weights of an even subdivision add up
    // to 1, as the paper says they do.
    vec2 middle = area > 0.0 ? moment / area : vec2(0.0);
    if (constants.usesPaperWeights && area > 0.0) {
        float paper = 1.0 / float(((1 << deepest) + 1) * ((1 << deepest) + 1));
        radiance *= paper / area;
        area = paper;
    }
    return Cell(radiance, area, middle);
}

// Bit x: the quad whose left edge is column x of the 9 x 9 coarse vertices is a leaf.
uint leafRow(int index) {
    int level = findMSB(uint(index) + 1u);
    uint row = 0u;
    for (int x = 0; x < (1 << level); ++x) {
        if (isLeaf(level, ivec2(x, index + 1 - (1 << level)))) row |= 1u << (x * (8 >> level));
    }
    return row;
}

void main() {
    int vertex = int(gl_LocalInvocationIndex);
    if (vertex < latticeVertices) {
        Cell cell = cellOf(vertex);
        samples[vertex].radianceShare = cell.radianceShare;
        samples[vertex].areaShare = cell.areaShare;
        samples[vertex].cellSide = sqrt(cell.areaShare);
        samples[vertex].cellMiddleU = cell.middle.x;
        samples[vertex].cellMiddleV = cell.middle.y;
        isUsed[vertex] = cell.areaShare > 0.0;
    }
    if (vertex < 15) subdivision.leafRows[vertex] = leafRow(vertex);
    barrier();
    if (vertex >= latticeVertices) return;
    // By their place on the light: the sum shall not depend on the order in which they were found.
    int before = 0;
    for (int i = 0; i < vertex; ++i) before += int(isUsed[i]);
    if (isUsed[vertex]) slotInOrder[before] = subdivision.slotOfVertex[vertex];
    if (vertex == latticeVertices - 1) plan.evaluated = ivec4(before + int(isUsed[vertex]), 0, 0, 0);
}
