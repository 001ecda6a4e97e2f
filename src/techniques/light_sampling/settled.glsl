// SPDX-License-Identifier: Apache-2.0
// What the comparison of coarse samples settles for a pixel. Where the four corners of a quad of level 3 agree, the
// test has nothing to object to the quad in this pixel, and the samples that others made necessary within it would
// agree, too: they need no look-up. Includer declares `shadowBits`, `subdivision` and `samples`.
struct Comparison {
    uvec4 shadows;    // bits as in lattice_bits.glsl, of vertices in the tree
    uvec4 tree;       // which vertices these are
    uvec4 counted;    // which of them count for this receiver
    uvec4 border;     // which of them are corners of leaves, or of unsettled quads, whose corners disagree
    uvec2 unsettled;  // 8 rows of 8 bits: split quads of level 3 whose corners disagree, or do not all count
};

Comparison loadComparison(ivec2 pixel) {
    const uint[3] tree = subdivision.coarseVertices;
    Comparison comparison;
    comparison.tree = uvec4(tree[0], tree[1], tree[2], 0u);
    comparison.shadows = texelFetch(shadowBits, pixel, 0) & comparison.tree;
    return comparison;
}

bool isAnyShadowed(Comparison comparison) { return comparison.shadows != uvec4(0u); }

// All of the light is above the horizon, as far as its corners tell, and all of its samples agree. (In a textured light
// there may be a channel in which nothing shines: nothing is seen of it even where all is lit.)
bool isSettled(Comparison comparison, Receiver receiver) {
    if (isAnyShadowed(comparison) && comparison.shadows != comparison.tree) return false;
    if (comparison.tree == uvec4(0u)) return false;
#ifdef COLORED
    if (!isAnyShadowed(comparison)) return false;
#endif
    for (int corner = 0; corner < 4; ++corner) {
        int vertex = (latticeSide - 1) * ((corner & 1) + latticeSide * (corner >> 1));
        precise VALUE weight = countOf(samples[vertex], receiver) * WEIGHT(samples[vertex]);
        if (weight == VALUE(0.0)) return false;
    }
    return true;
}

int vertexOf(int word, int bit) { return 2 * ((3 * word + bit / 9) * latticeSide + bit % 9); }

void findUnsettled(inout Comparison comparison) {
    comparison.unsettled = uvec2(0u);
    for (int y = 0; y < 8; ++y) {
        uint quads = subdivision.deepestRows[y];
        if (quads == 0u) continue;
        quads &= penumbraOf(sumsOfRow(comparison.shadows, y, 1)) | ~sumsOfRow(comparison.counted, y, 1).fours;
        comparison.unsettled[y / 4] |= quads << (8 * (y % 4));
    }
}

void addToBorder(inout Comparison comparison, int row, int stride, uint quads) {
    quads |= quads << stride;
    comparison.border[row / 3] |= quads << (9 * (row % 3));
    comparison.border[(row + stride) / 3] |= quads << (9 * ((row + stride) % 3));
}

void findBorder(inout Comparison comparison) {
    comparison.border = uvec4(0u);
    for (int i = 0; i < 15; ++i) {
        int level = findMSB(uint(i) + 1u), stride = 8 >> level, row = (i + 1 - (1 << level)) * stride;
        uint quads = subdivision.leafRows[i];
        if (level == 3) quads |= subdivision.deepestRows[row];
        if (quads == 0u) continue;
        quads &= penumbraOf(sumsOfRow(comparison.shadows, row, stride));
        if (quads != 0u) addToBorder(comparison, row, stride, quads);
    }
    comparison.border &= comparison.counted;
}

bool isQuadIn(uvec2 quads, ivec2 quad) { return (quads[quad.y / 4] >> (8 * (quad.y % 4) + quad.x) & 1u) != 0u; }

// Whether quads that have the vertex on their rim or within are settled, and with which result.
bool isAgreed(Comparison comparison, int vertex, out bool isLit) {
    isLit = true;
    ivec2 place = ivec2(vertex % latticeSide, vertex / latticeSide);
    ivec2 low = max((place - 1) / 2, ivec2(0)), high = min(place / 2, ivec2(7));
    if (all(equal(place % 2, ivec2(0)))) return false;
    for (int i = 0; i < 4; ++i) {
        ivec2 quad = ivec2((i & 1) == 0 ? low.x : high.x, (i >> 1) == 0 ? low.y : high.y);
        if (isQuadIn(comparison.unsettled, quad)) return false;
        bool isSplit = (subdivision.deepestRows[quad.y] >> quad.x & 1u) != 0u;
        if (isSplit) isLit = (bitRow(comparison.shadows, quad.y) >> quad.x & 1u) == 0u;
    }
    return true;
}
