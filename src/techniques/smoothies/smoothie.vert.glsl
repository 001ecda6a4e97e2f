// SPDX-License-Identifier: Apache-2.0
#version 450
#ifndef LAYER_BY_LAYER
#extension GL_ARB_shader_viewport_layer_array : require
#endif
// Chan and Durand 2003, section 3, step 3: a rectangle on each silhouette edge, in the light's window, and at both ends
// the part of the corner between the edge's normal and the vertex's, which is the mean over all silhouette edges that
// meet there. See README.md, "Corners".
// Variants: LAYER_BY_LAYER, where the framebuffer holds a single layer; INNER, for the half within the blocker.
#include "src/techniques/common/light_camera_io.h"
#include "src/techniques/smoothies/smoothie_edges_io.h"

layout(std430, binding = 0) readonly buffer LightCameras { LightCameraConstants lightCameras[]; };
layout(std430, binding = 2) readonly buffer SmoothieEdges { SmoothieEdge smoothieEdges[]; };
layout(location = 1) uniform uint capacity;
#ifdef LAYER_BY_LAYER
layout(location = 2) uniform int layer;
#endif

layout(location = 0) flat out vec4 edge;
layout(location = 1) flat out vec2 nearness;
layout(location = 2) flat out int cameraOfEdge;

// Rasterising the edge once for the blocker and once for the smoothie may disagree by the precision of a vertex.
const float overlapTexels = 0.02;

void main() {
#ifdef LAYER_BY_LAYER
    int camera = layer;
#else
    int camera = gl_InstanceID;
    gl_Layer = camera;
#endif
    SmoothieEdge smoothie = smoothieEdges[uint(camera) * capacity + uint(gl_VertexID / verticesPerSmoothie)];
    cameraOfEdge = camera;
    edge = smoothie.ends;
    nearness = smoothie.nearness;
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // nothing is drawn where we return early
    if (smoothie.widths == vec2(0.0)) return;

    LightCameraConstants c = lightCameras[camera];
    vec2 along = normalize(edge.zw - edge.xy);
#ifdef INNER
    float towards = -1.0;
#else
    float towards = 1.0;
#endif
    vec2 side = towards * vec2(along.y, -along.x);
    int corner = gl_VertexID % verticesPerSmoothie;
    vec2 place;
    if (corner < 6) {
        const vec2 corners[6] = {vec2(0, 0), vec2(1, 0), vec2(1, 1), vec2(0, 0), vec2(1, 1), vec2(0, 1)};
        // Nearness is linear along the edge, and the width in nearness.
        float width = mix(smoothie.widths.x, smoothie.widths.y, corners[corner].x);
        float across = mix(-overlapTexels * c.depth.w, width, corners[corner].y);
        place = mix(edge.xy, edge.zw, corners[corner].x) + across * side;
    } else {
        bool atB = corner >= 12;
        vec2 tip = atB ? edge.zw : edge.xy;
        vec2 normal = towards * (atB ? smoothie.normals.zw : smoothie.normals.xy);
        vec2 end = atB ? along : -along;
        if (normal == vec2(0.0)) normal = end;  // no mean: a quarter circle closes the edge off
        // Where the corner is folded the other way, the rectangles overlap and nothing is left to fill.
        if (dot(normal, end) <= 0.0) return;
        // Two tangents enclose the arc from the edge's normal to the vertex's.
        vec2 middle = side + normal;
        middle *= 2.0 / dot(middle, middle);
        vec2 arc[6] = {vec2(0.0), side, middle, vec2(0.0), middle, normal};
        place = tip + (atB ? smoothie.widths.y : smoothie.widths.x) * arc[corner % 6];
    }
    gl_Position = vec4(2.0 * (place - c.window.xy) * c.window.zw - 1.0, 0.5, 1.0);
}
