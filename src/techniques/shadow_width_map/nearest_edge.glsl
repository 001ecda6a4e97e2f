// SPDX-License-Identifier: Apache-2.0
// How the passes that find nearest edges pass them on. An edge texel sees the nearer surface of a
// discontinuity; of its four sides, those count that face texels which see the farther one, or nothing.

const ivec2 edgeDirections[4] = ivec2[](ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1));

// In a column: row (12 bits) and sides (4 bits, in the order above). Without sides: no edge.
uint packInColumn(int row, uint sides) { return uint(row) | sides << 12; }
int rowInColumn(uint entry) { return int(entry & 0xfffu); }
bool isEdgeInColumn(uint entry) { return entry >> 12 != 0u; }

// In the map: column, row and sides.
uint packEdge(int column, uint inColumn) { return uint(column) | inColumn << 12; }
ivec2 edgeTexel(uint edge) { return ivec2(edge & 0xfffu, edge >> 12 & 0xfffu); }

// Of an edge texel's sides, the one whose middle is nearest to a place in the map.
ivec2 nearestSide(uint edge, vec2 place_px) {
    vec2 way_px = place_px - (vec2(edgeTexel(edge)) + 0.5);
    vec4 towards = vec4(way_px.x, -way_px.x, way_px.y, -way_px.y);
    ivec2 nearest = ivec2(0);
    float most = -1e9;
    for (int i = 0; i < 4; ++i) {
        if ((edge >> (24 + i) & 1u) == 0u || towards[i] <= most) continue;
        most = towards[i];
        nearest = edgeDirections[i];
    }
    return nearest;
}
vec2 middleOf(uint edge, ivec2 side) { return vec2(edgeTexel(edge)) + 0.5 + 0.5 * vec2(side); }
