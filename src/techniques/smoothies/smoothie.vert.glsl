// SPDX-License-Identifier: Apache-2.0
#version 450
// A silhouette edge a vertex, as smoothie_edges.comp.glsl wrote it. Read as attributes, since storage blocks are read lane
// by lane on software rasterisers.
layout(location = 0) in vec4 ends;
layout(location = 1) in vec4 normals;
layout(location = 2) in vec4 nearnessAndWidths;

layout(location = 0) flat out vec4 edgeEnds;
layout(location = 1) flat out vec4 edgeNormals;
layout(location = 2) flat out vec4 edgeNearnessAndWidths;
layout(location = 3) flat out uint number;

void main() {
    edgeEnds = ends;
    edgeNormals = normals;
    edgeNearnessAndWidths = nearnessAndWidths;
    number = uint(gl_VertexID);
}
