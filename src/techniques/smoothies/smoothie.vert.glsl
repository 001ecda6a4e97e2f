// SPDX-License-Identifier: Apache-2.0
#version 450
#ifndef LAYER_BY_LAYER
#extension GL_ARB_shader_viewport_layer_array : require
#endif
// Chan and Durand 2003, section 3, step 3: a smoothie for each silhouette edge, built in the light's window: a rectangle
// and, at both ends, the part of the corner between the edge's normal and the vertex's, which is the mean over all
// silhouette edges that meet there. See README.md, "Corners".
// Variants: LAYER_BY_LAYER, where the framebuffer holds a single layer; INNER, for the half within the blocker.
#define DEPTH_MAP_UNIT 0
#define DEPTH_MAP_BLOCK 0
#define SMOOTHIE_BLOCK 1
#include "src/techniques/smoothies/smoothies.glsl"
#include "src/geometry/silhouettes_io.h"
#include "src/techniques/smoothies/vertex_normals_io.h"

layout(std430, binding = 2) readonly buffer Silhouettes { SilhouetteEdge silhouettes[]; };
layout(std430, binding = 3) readonly buffer VertexNormals { ivec4 vertexNormals[]; };
#ifdef LAYER_BY_LAYER
layout(location = 1) uniform int layer;
#endif

layout(location = 0) flat out vec4 edge;      // ends in the window, the blocker to the left
layout(location = 1) flat out vec2 nearness;  // at both ends
layout(location = 2) flat out int cameraOfEdge;

// Rasterising the edge once for the blocker and once for the smoothie may disagree by the precision of a vertex.
const float overlapTexels = 0.02;

// Moves the segment's ends to where f, linear between its values at both ends, becomes positive. False: nowhere.
bool clip(inout vec2 segment, float fa, float fb) {
    if (fa < 0.0 && fb < 0.0) return false;
    if (fa < 0.0) segment.x = max(segment.x, fa / (fa - fb));
    if (fb < 0.0) segment.y = min(segment.y, fa / (fa - fb));
    return segment.x < segment.y;
}

float largestWidth(int camera, vec2 place, float blocker) {
    // The two axes bound the extent in every direction.
    float half_m = lightExtent(camera, place, vec2(1.0, 0.0)).half_m + lightExtent(camera, place, vec2(0.0, 1.0)).half_m;
    return smoothieWidth(camera, half_m, blocker, smoothies[camera].nearness.x);
}

// The mean of the outward normals at a vertex, in the window. Normals of edges through a vertex are kept as the planes
// that they span with the light, all of which hold the ray through the vertex. Where edges cancel (the tip of a
// needle), the corner is rounded by a quarter at each.
vec2 vertexNormal(int camera, uint vertex, vec2 side) {
    vec2 normal = (mat3(lightCameras[camera].faceFromLight) * vec3(vertexNormals[vertex].xyz)).xy;
    float size = length(normal);
    // Fixed point leaves some 1e-5 of direction; a mean that points away from this edge would need more than a quarter.
    if (size < 1e-3 * vertexNormalScale) return vec2(0.0);
    normal /= size;
    return dot(normal, side) > -0.5 ? normal : vec2(0.0);
}

void main() {
#ifdef LAYER_BY_LAYER
    int camera = layer;
#else
    int camera = gl_InstanceID;
    gl_Layer = camera;
#endif
    cameraOfEdge = camera;
    edge = vec4(0.0);
    nearness = vec2(0.0);
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // nothing is drawn where we return early

    SilhouetteEdge silhouette = silhouettes[gl_VertexID / verticesPerSmoothie];
    LightCameraConstants c = lightCameras[camera];
    bool leftFirst = silhouette.weight > 0;
    vec3 a = (c.faceFromLight * vec4(leftFirst ? silhouette.aLight : silhouette.bLight, 1.0)).xyz;
    vec3 b = (c.faceFromLight * vec4(leftFirst ? silhouette.bLight : silhouette.aLight, 1.0)).xyz;

    // Only what lies before the farthest receiver and in front of the camera has a place.
    float farthest = smoothies[camera].nearness.x;
    float nearest_m = isOrthographic(camera) ? -smoothies[camera].nearness.y : 1.0 / smoothies[camera].nearness.y;
    vec2 segment = vec2(0.0, 1.0);
    if (!clip(segment, a.z - nearest_m, b.z - nearest_m)) return;
    vec3 step3 = b - a;
    b = a + segment.y * step3;
    a += segment.x * step3;
    vec2 placeA = isOrthographic(camera) ? a.xy : a.xy / a.z;
    vec2 placeB = isOrthographic(camera) ? b.xy : b.xy / b.z;
    vec2 ends = vec2(nearnessOf(camera, a.z), nearnessOf(camera, b.z));
    if (max(ends.x, ends.y) <= farthest) return;

    // The part of the edge whose smoothie reaches into the window.
    float width = max(largestWidth(camera, placeA, ends.x), largestWidth(camera, placeB, ends.y));
    vec2 low = c.window.xy - width, high = c.window.xy + 1.0 / c.window.zw + width;
    segment = vec2(0.0, 1.0);
    if (!clip(segment, placeA.x - low.x, placeB.x - low.x) || !clip(segment, high.x - placeA.x, high.x - placeB.x) ||
        !clip(segment, placeA.y - low.y, placeB.y - low.y) || !clip(segment, high.y - placeA.y, high.y - placeB.y)) {
        return;
    }
    vec2 stepWindow = placeB - placeA;
    edge = vec4(placeA + segment.x * stepWindow, placeA + segment.y * stepWindow);
    nearness = vec2(mix(ends.x, ends.y, segment.x), mix(ends.x, ends.y, segment.y));
    float span = distance(edge.xy, edge.zw);
    if (!(span > 1e-6 * c.depth.w)) return;  // points at the light: its neighbours' corners cover it

    vec2 along = (edge.zw - edge.xy) / span;
    vec2 side = vec2(along.y, -along.x);
    vec2 normalA = vertexNormal(camera, leftFirst ? silhouette.a : silhouette.b, side);
    vec2 normalB = vertexNormal(camera, leftFirst ? silhouette.b : silhouette.a, side);
#ifdef INNER
    side = -side;
    normalA = -normalA;
    normalB = -normalB;
#endif
    // No mean normal: a quarter circle closes the edge off.
    if (normalA == vec2(0.0)) normalA = -along;
    if (normalB == vec2(0.0)) normalB = along;
    int corner = gl_VertexID % verticesPerSmoothie;
    vec2 overlap = -overlapTexels * c.depth.w * side;
    vec2 place;
    if (corner < 6) {
        const vec2 corners[6] = {vec2(0, 0), vec2(1, 0), vec2(1, 1), vec2(0, 0), vec2(1, 1), vec2(0, 1)};
        place = mix(edge.xy, edge.zw, corners[corner].x) + mix(overlap, width * side, corners[corner].y);
    } else {
        bool atB = corner >= 12;
        vec2 tip = atB ? edge.zw : edge.xy;
        vec2 normal = atB ? normalB : normalA;
        // Where the corner is folded the other way, the rectangles overlap and nothing is left to fill.
        if (dot(normal, atB ? along : -along) <= 0.0) return;
        // Two tangents enclose the arc from the edge's normal to the vertex's.
        vec2 middle = side + normal;
        vec2 arc[6] = {vec2(0.0), side, 2.0 * middle / dot(middle, middle), vec2(0.0), 2.0 * middle / dot(middle, middle), normal};
        place = tip + width * arc[corner % 6];
    }
    gl_Position = vec4(2.0 * (place - c.window.xy) * c.window.zw - 1.0, 0.5, 1.0);
}
