// SPDX-License-Identifier: Apache-2.0
// A light in coordinates of its own: how far around its centre, in quarters of its area, and how far towards the border.
// Requires volumes_io.h.

const int tableColumns = 512;  // around
const int tableRows = 128;     // from the centre to the border, where another row says 0

// Where the border is, so many quarters from the middle of the right side on.
vec2 borderAt(float quarters) {
    if (volume.light.shape != shapeRect) {
        const float quarter = 1.57079632679489661923;
        return vec2(cos(quarter * quarters), sin(quarter * quarters));
    }
    float side = floor(quarters + 0.5), along = 2.0 * (quarters - side);
    int which = int(side) & 3;
    return which == 0 ? vec2(1.0, along) : which == 1 ? vec2(-along, 1.0) : which == 2 ? vec2(-1.0, -along) : vec2(along, -1.0);
}
