// SPDX-License-Identifier: Apache-2.0
// How the passes that find nearest edges pass them on. An edge is a side of a texel that sees the nearer surface of a
// discontinuity; the side faces the texel that sees the farther one, or nothing.

const ivec2 edgeDirections[4] = ivec2[](ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1));

// In a column: row (13 bits) and direction (2 bits).
const uint noEdgeInColumn = 0xffffu;
uint packInColumn(int row, int direction) { return uint(row) | uint(direction) << 13; }
int rowInColumn(uint entry) { return int(entry & 0x1fffu); }

// In the map: column, row and direction.
const uint noEdge = 0xffffffffu;
uint packEdge(int column, uint inColumn) { return uint(column) | inColumn << 13; }
ivec2 edgeTexel(uint edge) { return ivec2(edge & 0x1fffu, edge >> 13 & 0x1fffu); }
ivec2 edgeDirection(uint edge) { return edgeDirections[edge >> 26 & 3u]; }
// The middle of the edge, in texels from the map's corner.
vec2 edgePlace(uint edge) { return vec2(edgeTexel(edge)) + 0.5 + 0.5 * vec2(edgeDirection(edge)); }
