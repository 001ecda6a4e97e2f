// SPDX-License-Identifier: Apache-2.0
// What a receiver sees of each cell of a rectangle: CELLS along each side, row after row from its corner at -X, -Y.

// A layer a cell: weights of the samples that are seen, and of all. Nothing where no sample is, and where the receiver sees all
// of the light, or nothing, for certain: there every cell is as the whole.
layout(rg32f) uniform image2DArray cells;

vec2 inCell[CELLS * CELLS];

void beginCells() {
    for (int i = 0; i < CELLS * CELLS; ++i) inCell[i] = vec2(0.0);
}

// `place` is from -1 to 1 on the light.
void addToCell(vec2 place, float weight, bool isSeen) {
    ivec2 cell = clamp(ivec2((0.5 + 0.5 * place) * float(CELLS)), 0, CELLS - 1);
    inCell[cell.y * CELLS + cell.x] += vec2(isSeen ? weight : 0.0, weight);
}

// To what earlier rounds have left there.
void saveCells(ivec2 pixel) {
    for (int i = 0; i < CELLS * CELLS; ++i)
        imageStore(cells, ivec3(pixel, i), vec4(imageLoad(cells, ivec3(pixel, i)).rg + inCell[i], 0.0, 0.0));
}
