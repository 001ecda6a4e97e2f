// SPDX-License-Identifier: Apache-2.0
// Shadow values of the samples up to level 3, a bit each. They lie on every second row and column of the lattice: 9 x 9
// bits, three rows in each of three words; so a level's quads are all compared at once, and what the comparison has
// looked up needs no second look in the evaluation.
struct BitPlace {
    int word;
    uint mask;
};

BitPlace bitPlace(int vertex) {
    ivec2 coarse = ivec2(vertex % latticeSide, vertex / latticeSide) / 2;
    return BitPlace(coarse.y / 3, 1u << (9 * (coarse.y % 3) + coarse.x));
}

uint bitRow(uvec4 bits, int row) {
    uint word = row < 3 ? bits.x : row < 6 ? bits.y : bits.z;
    return (word >> (9 * (row % 3))) & 511u;
}
