// SPDX-License-Identifier: Apache-2.0
#version 450
// Chan and Durand 2003, section 3, step 3: a rectangle on each silhouette edge, in the light's window, and at both ends
// the part of the corner between the edge's normal and the vertex's, which is the mean over all silhouette edges that
// meet there. See README.md, "Corners".
#include "src/techniques/smoothies/smoothie_edges_io.h"
#include "src/techniques/smoothies/smoothies.glsl"
#include "src/techniques/smoothies/layers.glsl"

layout(std430, binding = 2) readonly buffer SmoothieEdges { SmoothieEdge smoothieEdges[]; };
layout(location = 1) uniform int camera;
layout(location = 2) uniform int layer;
layout(location = 3) uniform uint firstEdge;  // of this camera

layout(location = 0) flat out uint edgeNumber;
layout(location = 1) flat out vec2 outward;  // the edge's normal, away from the blocker
layout(location = 2) out vec2 place;
layout(location = 3) out vec2 closest;   // the edge's point that is closest to the place
layout(location = 4) out float blocker;  // the nearness there

// Smoothies are drawn coarser than the depth map. A texel that holds any place on this side of the edge may have its centre
// beyond it.
const float overlap = 0.75 * float(smoothieTexel_px);

void main() {
    edgeNumber = uint(gl_VertexID / verticesPerSmoothie);
    SmoothieEdge edge = smoothieEdges[firstEdge + edgeNumber];
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // nothing is drawn where we return early
    if (edge.widths == vec2(0.0)) return;
    vec2 along = normalize(edge.ends.zw - edge.ends.xy);
    outward = vec2(along.y, -along.x);
    if (layer != layerOuter && layer != innerLayer(outward)) return;

    float towards = layer == layerOuter ? 1.0 : -1.0;
    vec2 side = towards * outward;
    int corner = gl_VertexID % verticesPerSmoothie;
    LightCameraConstants c = smoothies[camera].camera;
    if (corner < 6) {
        const vec2 corners[6] = {vec2(0, 0), vec2(1, 0), vec2(1, 1), vec2(0, 0), vec2(1, 1), vec2(0, 1)};
        // Nearness is linear along the edge, and the width in nearness.
        float s = corners[corner].x;
        closest = mix(edge.ends.xy, edge.ends.zw, s);
        blocker = mix(edge.nearness.x, edge.nearness.y, s);
        float width = mix(edge.widths.x, edge.widths.y, s);
        place = closest + mix(-overlap * c.depth.w, width, corners[corner].y) * side;
    } else {
        bool atB = corner >= 12;
        closest = atB ? edge.ends.zw : edge.ends.xy;
        blocker = atB ? edge.nearness.y : edge.nearness.x;
        vec2 normal = towards * (atB ? edge.normals.zw : edge.normals.xy);
        vec2 end = atB ? along : -along;
        if (normal == vec2(0.0)) normal = end;  // no mean: a quarter circle closes the edge off
        // Where the corner is folded the other way, the rectangles overlap and nothing is left to fill.
        if (dot(normal, end) <= 0.0) return;
        // Two tangents enclose the arc from the edge's normal to the vertex's.
        vec2 middle = side + normal;
        middle *= 2.0 / dot(middle, middle);
        vec2 arc[6] = {vec2(0.0), side, middle, vec2(0.0), middle, normal};
        place = closest + (atB ? edge.widths.y : edge.widths.x) * arc[corner % 6];
    }
    gl_Position = vec4(2.0 * (place - c.window.xy) * c.window.zw - 1.0, 0.5, 1.0);
}
