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

// The sum of four shadow values, 0 to 4, as three binary digits.
struct Sums {
    uint ones, twos, fours;
};

Sums sumsOfRow(uvec4 bits, int row, int stride) {
    uint low = bitRow(bits, row), high = bitRow(bits, row + stride);
    uint a = low, b = low >> stride, c = high, d = high >> stride;
    uint ab = a ^ b, cd = c ^ d;
    return Sums(ab ^ cd, (a & b) ^ (c & d) ^ (ab & cd), a & b & c & d);
}

// Values 1 to 3: the penumbra.
uint penumbraOf(Sums sums) { return sums.ones | sums.twos; }
