// SPDX-License-Identifier: Apache-2.0
// Silhouettes as the exact mode keeps them. The map is divided into square cells of a few texels; each keeps, of every
// kind, one edge: a short straight piece of a silhouette. An edge texel sees the surface that ends there; its sides towards
// what is beyond are the silhouette. In layers, all maps of a kind, then those of the next:
//   0  outlines of the casters' union, before nothing
//   1  inner edges, where a caster stands out against another
//   2  hidden edges, where what is farthest ends beneath another caster
//
// Packed in four words; the first is 0 where there is no edge:
//   texel (12 bits each way), direction of the one beyond (2 bits), 1 << 31
//   middle of the piece from the texel's centre, in eighths; unit normal towards what is beyond (8 bits each)
//   stored depths of the two texels

const ivec2 edgeDirections[4] = ivec2[](ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1));

bool isEdge(uvec4 edge) { return edge.x != 0u; }
ivec2 edgeTexel(uvec4 edge) { return ivec2(edge.x & 0xfffu, edge.x >> 12 & 0xfffu); }
ivec2 texelBehind(uvec4 edge) { return edgeTexel(edge) + edgeDirections[edge.x >> 24 & 3u]; }
float storedAtEdge(uvec4 edge) { return uintBitsToFloat(edge.z); }
float storedBehindEdge(uvec4 edge) { return uintBitsToFloat(edge.w); }
vec2 middleOf(uvec4 edge) { return vec2(edgeTexel(edge)) + 0.5 + 8.0 * unpackSnorm4x8(edge.y).xy; }
vec2 normalOf(uvec4 edge) { return unpackSnorm4x8(edge.y).zw; }

uvec4 packEdge(ivec2 texel, uint direction, vec2 middle_px, vec2 normal, float stored, float storedBehind) {
    return uvec4(uint(texel.x) | uint(texel.y) << 12 | direction << 24 | 1u << 31,
                 packSnorm4x8(vec4((middle_px - vec2(texel) - 0.5) / 8.0, normal)), floatBitsToUint(stored),
                 floatBitsToUint(storedBehind));
}

// The cell of a place; a whole division, which cell widths (powers of two) spare, takes software rasterizers long.
ivec2 cellAt(vec2 place_px, int cell_px) { return ivec2(place_px) >> findLSB(cell_px); }

// The place on the edge's piece that is nearest to a place in the map.
vec2 nearestOnEdge(uvec4 edge, vec2 place_px, float cell_px) {
    vec2 middle = middleOf(edge), normal = normalOf(edge);
    vec2 along = vec2(-normal.y, normal.x);
    return middle + along * clamp(dot(place_px - middle, along), -0.75 * cell_px, 0.75 * cell_px);
}

// The same middle, kept off the borders of the edge's own cell, so that it tells the cell.
vec2 placeInCell(uvec4 edge, ivec2 cell, int cell_px) {
    return clamp(middleOf(edge), (vec2(cell) + 0.01) * float(cell_px), (vec2(cell) + 0.99) * float(cell_px));
}
