// SPDX-License-Identifier: Apache-2.0
#version 450
// Second half of the distance transform: along each row, the lower envelope of the parabolas that its columns' nearest
// edges make. One invocation a row. The stack of the envelope lies in the row of the output itself: an entry's place
// never exceeds the column that it begins at, so that reading backwards, each is read before it is overwritten.
layout(local_size_x = 16) in;

#include "src/techniques/common/depth_map.glsl"
#include "src/techniques/shadow_width_map/edge_cells.glsl"
#include "src/techniques/shadow_width_map/shadow_width_io.h"
#include "src/techniques/shadow_width_map/spread.glsl"

layout(std140) uniform Constants { EdgeConstants edges; };
uniform usampler2DArray cellEdges;
uniform sampler2DArray columns_px;
layout(rgba32ui) uniform uimage2DArray nearestEdges;
layout(rg32f) uniform image2DArray widths;

struct Parabola {
    vec2 edge_px;
    float height;  // squared distance to the edge, in the edge's column
    int begin;     // the first cell that it is lowest in
};

uvec4 pack(Parabola p) { return uvec4(floatBitsToUint(vec3(p.edge_px, p.height)), uint(p.begin)); }
Parabola unpack(uvec4 entry) {
    vec3 p = uintBitsToFloat(entry.xyz);
    return Parabola(p.xy, p.z, int(entry.w));
}

float centerOf(int cell) { return (float(cell) + 0.5) * float(edges.cell_px); }
float valueAt(Parabola p, int cell) {
    float across = centerOf(cell) - p.edge_px.x;
    return across * across + p.height;
}

// The nearest edge of each cell in a row, of one kind.
void sweepRow(ivec3 cell, int cells) {
    int top = -1;
    Parabola p = Parabola(vec2(0.0), 0.0, 0);
    for (cell.x = 0; cell.x < cells; ++cell.x) {
        Parabola next;
        next.edge_px = texelFetch(columns_px, cell, 0).xy;
        if (next.edge_px.y < 0.0) continue;
        next.height = (next.edge_px.y - centerOf(cell.y)) * (next.edge_px.y - centerOf(cell.y));
        next.begin = 0;
        while (top >= 0 && valueAt(p, p.begin) > valueAt(next, p.begin)) {
            if (--top >= 0) p = unpack(imageLoad(nearestEdges, ivec3(top, cell.yz)));
        }
        if (top >= 0) {
            // Where `next` gets lower; not before p.begin, since it is not lower there.
            float dx = next.edge_px.x - p.edge_px.x;
            float across = 0.5 * (next.edge_px.x + p.edge_px.x + (next.height - p.height) / dx);
            next.begin = max(p.begin, int(min(floor(across / float(edges.cell_px) - 0.5), float(cells)))) + 1;
            if (next.begin >= cells) continue;
        }
        imageStore(nearestEdges, ivec3(++top, cell.yz), pack(next));
        p = next;
    }

    int map = cell.z % edges.mapCount;
    float steepest = widestPerExtent(map);
    for (cell.x = cells - 1; cell.x >= 0; --cell.x) {
        uvec4 edge = uvec4(0u);
        vec2 width = vec2(2.0 * float(cells * edges.cell_px), noPenumbra);
        if (top >= 0) {
            edge = texelFetch(cellEdges, ivec3(cellAt(p.edge_px, edges.cell_px), cell.z), 0);
            vec2 center_px = (vec2(cell.xy) + 0.5) * float(edges.cell_px);
            width.x = distance(center_px, nearestOnEdge(edge, center_px, float(edges.cell_px)));
            width.y = penumbraBegins(map, storedAtEdge(edge), width.x - 1.5 * float(edges.cell_px), edges.halfExtent * steepest);
            if (cell.x == p.begin && --top >= 0) p = unpack(imageLoad(nearestEdges, ivec3(top, cell.yz)));
        }
        imageStore(nearestEdges, cell, edge);
        // In the outlines' layer for all edges.kinds.
        if (cell.z + edges.mapCount < edges.kinds * edges.mapCount) width.y = max(width.y, imageLoad(widths, cell + ivec3(0, 0, edges.mapCount)).y);
        imageStore(widths, cell, width.xyxy);
    }
}

void main() {
    int cells = imageSize(nearestEdges).x;
    ivec3 cell = ivec3(0, gl_GlobalInvocationID.xy);
    if (cell.y >= cells) return;
    for (int kind = edges.kinds - 1; kind >= 0; --kind) sweepRow(cell + ivec3(0, 0, kind * edges.mapCount), cells);
}
