// SPDX-License-Identifier: Apache-2.0
#version 450
// First half of an exact Euclidean distance transform (Meijster, Roerdink and Hesselink 2000), over cells: where in each
// cell's column the nearest edge is, down and up again; one invocation a column. Negative: there is none.
layout(local_size_x = 16) in;

#include "src/techniques/shadow_width_map/edge_cells.glsl"
#include "src/techniques/shadow_width_map/shadow_width_io.h"

layout(std140) uniform Constants { EdgeConstants edges; };
uniform usampler2DArray cellEdges;
layout(rg32f) uniform image2DArray columns_px;  // places in the map

void main() {
    int cells = textureSize(cellEdges, 0).x;
    ivec3 cell = ivec3(gl_GlobalInvocationID.x, 0, gl_GlobalInvocationID.y);
    if (cell.x >= cells) return;
    vec2 nearest_px = vec2(-1.0);
    for (cell.y = 0; cell.y < cells; ++cell.y) {
        uvec4 edge = texelFetch(cellEdges, cell, 0);
        if (isEdge(edge)) nearest_px = placeInCell(edge, cell.xy, edges.cell_px);
        imageStore(columns_px, cell, nearest_px.xyxy);
    }
    for (cell.y = cells - 2; cell.y >= 0; --cell.y) {
        float center_px = (float(cell.y) + 0.5) * float(edges.cell_px);
        vec2 own_px = imageLoad(columns_px, cell).xy;
        bool isNearer =
            own_px.y >= 0.0 && (nearest_px.y < 0.0 || abs(own_px.y - center_px) <= abs(nearest_px.y - center_px));
        if (isNearer) nearest_px = own_px;
        imageStore(columns_px, cell, nearest_px.xyxy);
    }
}
