// SPDX-License-Identifier: Apache-2.0
#version 450
// Chan and Durand 2003, section 3, step 3: a rectangle on each silhouette edge, in the light's window, and at both ends
// the part of the corner between the edge's normal and the vertex's, which is the mean over all silhouette edges that
// meet there. See README.md, "Corners". Then the same on the blocker's side. Variants: STORED_ALPHA, a layer a camera.
#include "src/techniques/smoothies/layers.glsl"
#include "src/techniques/smoothies/smoothies.glsl"

layout(points) in;
layout(triangle_strip, max_vertices = 28) out;

layout(std140) uniform Constants { ConstructionConstants construction; };
const int camera = 0;  // the block begins with the one that is drawn

layout(location = 0) flat in vec4 edgeEnds[1];
layout(location = 1) flat in vec4 edgeNormals[1];
layout(location = 2) flat in vec4 edgeNearnessAndWidths[1];
layout(location = 3) flat in uint number[1];

layout(location = 0) flat out uint edgeNumber;
layout(location = 1) flat out vec2 outward;  // the edge's normal, away from the blocker
layout(location = 2) flat out int isInner;
layout(location = 3) out vec2 place;
layout(location = 4) out vec2 closest;   // the edge's point that is closest to the place
layout(location = 5) out float blocker;  // the nearness there

// Smoothies are drawn coarser than the depth map: a texel that holds any place on this side of the edge may have its
// centre beyond it, or beyond an end of it.
const float overlapTexels = 0.75 * float(smoothieTexel_px);
// How much of that lies past the ends: enough to close the gaps around vertices of finely divided silhouettes.
const float pastEnds = 0.25;

struct End {
    vec2 place;
    vec2 normal;  // of the vertex, towards the half that is drawn; zero where there is none
    float nearness;
    float width;
};

void emit(End end, vec2 offset, vec2 normal, int layer) {
    MapWindow window = smoothies[camera].camera.window;
    edgeNumber = number[0];
    outward = normal;
    isInner = layer == layerOuter ? 0 : 1;
    closest = end.place;
    blocker = end.nearness;
    place = end.place + offset;
#ifdef STORED_ALPHA
    gl_Layer = construction.drawnCamera;
#else
    gl_Layer = layersPerCamera * construction.drawnCamera + layer;
#endif
    gl_Position = vec4(2.0 * (place - window.min) * window.perExtent - 1.0, 0.5, 1.0);
    EmitVertex();
}

void corner(End end, vec2 side, vec2 away, vec2 normal, int layer) {
    if (end.normal == vec2(0.0)) end.normal = away;  // no mean: a quarter circle closes the edge off
    // Where the corner is folded the other way, the rectangles overlap and nothing is left to fill.
    if (dot(end.normal, away) <= 0.0) return;
    // Two tangents enclose the arc from the edge's normal to the vertex's.
    vec2 middle = side + end.normal;
    middle *= 2.0 / dot(middle, middle);
    emit(end, end.width * side, normal, layer);
    emit(end, vec2(0.0), normal, layer);
    emit(end, end.width * middle, normal, layer);
    emit(end, end.width * end.normal, normal, layer);
    EndPrimitive();
}

void main() {
    vec4 nearnessAndWidths = edgeNearnessAndWidths[0];
    if (nearnessAndWidths.zw == vec2(0.0)) return;
    vec4 ends = edgeEnds[0], normals = edgeNormals[0];
    vec2 along = normalize(ends.zw - ends.xy);
    vec2 normal = vec2(along.y, -along.x);
    float overlap = overlapTexels * smoothies[camera].camera.depth.texelSize;
    int halves = smoothies[camera].hasInnerHalf ? 2 : 1;
    for (int i = 0; i < halves; ++i) {
        int layer = i == 0 ? layerOuter : innerLayer(normal);
        float towards = i == 0 ? 1.0 : -1.0;
        vec2 side = towards * normal;
        End a = End(ends.xy, towards * normals.xy, nearnessAndWidths.x, nearnessAndWidths.z);
        End b = End(ends.zw, towards * normals.zw, nearnessAndWidths.y, nearnessAndWidths.w);
        // Nearness is linear along the edge, and the width in nearness.
        emit(a, -overlap * (side + pastEnds * along), normal, layer);
        emit(b, -overlap * (side - pastEnds * along), normal, layer);
        emit(a, vec2(0.0), normal, layer);
        emit(b, vec2(0.0), normal, layer);
        emit(a, a.width * side, normal, layer);
        emit(b, b.width * side, normal, layer);
        EndPrimitive();
        corner(a, side, -along, normal, layer);
        corner(b, side, along, normal, layer);
    }
}
