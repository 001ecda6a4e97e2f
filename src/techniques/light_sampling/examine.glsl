// SPDX-License-Identifier: Apache-2.0
// The two-pass test (section 3.3.3, Figure 6) for a row of quads at once: bit x of a word is the quad whose left edge
// is column x of the 9 x 9 bits. Includer declares `shadowBits`.

uint equal(Sums a, Sums b) { return ~((a.ones ^ b.ones) | (a.twos ^ b.twos) | (a.fours ^ b.fours)); }

// Penumbra fragments without a different value in their 1-ring: the hard shadows are too far apart.
uint failingInRow(uvec4 ring[9], int row, int stride) {
    Sums middle = sumsOfRow(ring[4], row, stride);
    uint failing = penumbraOf(middle);
    if (failing == 0u) return 0u;
    for (int i = 0; i < 9; ++i) failing &= equal(middle, sumsOfRow(ring[i], row, stride));
    return failing;
}
