// SPDX-License-Identifier: Apache-2.0
#version 450
// Second half of the distance transform: along each row, the lower envelope of the parabolas that its columns' nearest
// edges make. One invocation a row. The stack of the envelope lies in the row of the output itself: an entry's place
// never exceeds the column that it begins at, so that reading backwards, each is read before it is overwritten.
layout(local_size_x = 16) in;

#include "src/techniques/shadow_width_map/nearest_edge.glsl"

layout(binding = 0) uniform usampler2DArray columns;
layout(binding = 0, r32ui) uniform uimage2DArray edges;
layout(binding = 1, r32f) uniform writeonly image2DArray widths_px;
layout(location = 0) uniform int mapCount;

struct Parabola {
    int column, begin;  // its edge's column; the first column that it is lowest in
    int height;         // squared distance to the edge, in the edge's column
    uint inColumn;
};

uint inColumnAt(ivec3 texel) {
    uvec2 both = texelFetch(columns, ivec3(texel.xy, texel.z % mapCount), 0).rg;
    return texel.z < mapCount ? both.x : both.y;
}

Parabola parabolaAt(ivec3 texel, int column, int begin) {
    Parabola p;
    p.column = column;
    p.begin = begin;
    p.inColumn = inColumnAt(ivec3(column, texel.yz));
    int distance_px = rowInColumn(p.inColumn) - texel.y;
    p.height = distance_px * distance_px;
    return p;
}

int valueAt(Parabola p, int column) { return (column - p.column) * (column - p.column) + p.height; }

void main() {
    int size_px = imageSize(edges).x;
    ivec3 texel = ivec3(0, gl_GlobalInvocationID.xy);
    if (texel.y >= size_px) return;

    int top = -1;
    Parabola p = Parabola(0, 0, 0, 0u);
    for (int column = 0; column < size_px; ++column) {
        if (!isEdgeInColumn(inColumnAt(ivec3(column, texel.yz)))) continue;
        Parabola next = parabolaAt(texel, column, 0);
        while (top >= 0 && valueAt(p, p.begin) > valueAt(next, p.begin)) {
            if (--top < 0) break;
            uint entry = imageLoad(edges, ivec3(top, texel.yz)).r;
            p = parabolaAt(texel, int(entry & 0xffffu), int(entry >> 16));
        }
        if (top >= 0) {
            // Where `next` gets lower; not before p.begin, since it is not lower there.
            int across = column * column - p.column * p.column + next.height - p.height;
            next.begin = 1 + across / (2 * (column - p.column));
            if (next.begin >= size_px) continue;
        }
        imageStore(edges, ivec3(++top, texel.yz), uvec4(uint(next.column) | uint(next.begin) << 16));
        p = next;
    }

    for (int column = size_px - 1; column >= 0; --column) {
        texel.x = column;
        uint edge = 0u;
        float width_px = float(2 * size_px);
        if (top >= 0) {
            edge = packEdge(p.column, p.inColumn);
            vec2 place_px = vec2(texel.xy) + 0.5;
            width_px = distance(middleOf(edge, nearestSide(edge, place_px)), place_px);
            if (column == p.begin && --top >= 0) {
                uint entry = imageLoad(edges, ivec3(top, texel.yz)).r;
                p = parabolaAt(texel, int(entry & 0xffffu), int(entry >> 16));
            }
        }
        imageStore(edges, texel, uvec4(edge));
        imageStore(widths_px, texel, vec4(width_px));
    }
}
