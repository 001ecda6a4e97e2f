// SPDX-License-Identifier: Apache-2.0
#version 450
// Chan and Durand 2003, section 3, step 3: where the smoothie of each silhouette edge goes, for each light camera, and
// how wide it must be. The paper foresees vertex stages that read the shadow map to size the smoothies (section 3.1).
layout(local_size_x = 64) in;

#define DEPTH_MAP_UNIT 0
#define DEPTH_MAP_BLOCK 0
#define SMOOTHIE_BLOCK 1
#include "src/techniques/smoothies/smoothies.glsl"
#include "src/geometry/silhouettes_io.h"
#include "src/techniques/smoothies/smoothie_edges_io.h"

layout(std430, binding = 2) readonly buffer Tiles { float farthestNearness[]; };
layout(std430, binding = 3) readonly buffer Silhouettes { SilhouetteEdge silhouettes[]; };
layout(std430, binding = 4) readonly buffer Commands { SilhouetteCommands commands; };
layout(std430, binding = 5) readonly buffer VertexNormals { ivec4 vertexNormals[]; };
layout(std430, binding = 6) writeonly buffer SmoothieEdges { SmoothieEdge smoothieEdges[]; };

layout(location = 0) uniform int cameraCount;
layout(location = 1) uniform uint capacity;  // edges for each camera

// Moves the segment's ends to where f, linear between its values at both ends, becomes positive. False: nowhere.
bool clip(inout vec2 segment, float fa, float fb) {
    if (fa < 0.0 && fb < 0.0) return false;
    if (fa < 0.0) segment.x = max(segment.x, fa / (fa - fb));
    if (fb < 0.0) segment.y = min(segment.y, fa / (fa - fb));
    return segment.x < segment.y;
}

float largestWidth(int camera, vec2 place, float blocker, float receiver) {
    // The two axes bound the extent in every direction.
    float half_m = lightExtent(camera, place, vec2(1.0, 0.0)).half_m + lightExtent(camera, place, vec2(0.0, 1.0)).half_m;
    return smoothieWidth(camera, half_m, blocker, receiver);
}

// No wider at either end than the farthest surface within reach asks for. What lies hidden behind the blocker is taken to
// be no farther than what shows around it.
vec2 boundByReceivers(int camera, vec2 placeA, vec2 placeB, vec2 nearness, vec2 widths) {
    vec4 window = lightCameras[camera].window;
    for (int i = 0; i < 2; ++i) {
        float reach = max(widths.x, widths.y);
        vec2 low = min(placeA, placeB) - reach, high = max(placeA, placeB) + reach;
        ivec2 first = texelOf(camera, low, tilesAcross), last = texelOf(camera, high, tilesAcross);
        ivec2 count = last - first + 1;
        if (count.x * count.y > 256) return widths;
        float farthest = smoothies[camera].nearness.y;
        for (int y = first.y; y <= last.y; ++y) {
            for (int x = first.x; x <= last.x; ++x) {
                farthest = min(farthest, farthestNearness[(camera * tilesAcross + y) * tilesAcross + x]);
            }
        }
        widths = min(widths, vec2(largestWidth(camera, placeA, nearness.x, farthest),
                                  largestWidth(camera, placeB, nearness.y, farthest)));
    }
    return widths;
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

SmoothieEdge build(int camera, uint index) {
    SmoothieEdge nothing = SmoothieEdge(vec4(0.0), vec4(0.0), vec2(0.0), vec2(0.0));
    SilhouetteEdge silhouette = silhouettes[index];
    LightCameraConstants c = lightCameras[camera];
    bool leftFirst = silhouette.weight > 0;
    vec3 a = (c.faceFromLight * vec4(leftFirst ? silhouette.aLight : silhouette.bLight, 1.0)).xyz;
    vec3 b = (c.faceFromLight * vec4(leftFirst ? silhouette.bLight : silhouette.aLight, 1.0)).xyz;

    // Only what lies before the farthest receiver and in front of the camera has a place.
    float farthest = smoothies[camera].nearness.x;
    float nearest_m = isOrthographic(camera) ? -smoothies[camera].nearness.y : 1.0 / smoothies[camera].nearness.y;
    vec2 segment = vec2(0.0, 1.0);
    if (!clip(segment, a.z - nearest_m, b.z - nearest_m)) return nothing;
    vec3 step3 = b - a;
    b = a + segment.y * step3;
    a += segment.x * step3;
    vec2 placeA = isOrthographic(camera) ? a.xy : a.xy / a.z;
    vec2 placeB = isOrthographic(camera) ? b.xy : b.xy / b.z;
    vec2 ends = vec2(nearnessOf(camera, a.z), nearnessOf(camera, b.z));
    if (max(ends.x, ends.y) <= farthest) return nothing;

    // The part of the edge whose smoothie reaches into the window.
    vec2 widths =
        vec2(largestWidth(camera, placeA, ends.x, farthest), largestWidth(camera, placeB, ends.y, farthest));
    float width = max(widths.x, widths.y);
    vec2 low = c.window.xy - width, high = c.window.xy + 1.0 / c.window.zw + width;
    segment = vec2(0.0, 1.0);
    if (!clip(segment, placeA.x - low.x, placeB.x - low.x) || !clip(segment, high.x - placeA.x, high.x - placeB.x) ||
        !clip(segment, placeA.y - low.y, placeB.y - low.y) || !clip(segment, high.y - placeA.y, high.y - placeB.y)) {
        return nothing;
    }
    vec2 stepWindow = placeB - placeA;
    vec4 edge = vec4(placeA + segment.x * stepWindow, placeA + segment.y * stepWindow);
    vec2 nearness = vec2(mix(ends.x, ends.y, segment.x), mix(ends.x, ends.y, segment.y));
    widths = vec2(mix(widths.x, widths.y, segment.x), mix(widths.x, widths.y, segment.y));
    widths = boundByReceivers(camera, edge.xy, edge.zw, nearness, widths);
    float span = distance(edge.xy, edge.zw);
    if (!(span > 1e-6 * c.depth.w)) return nothing;  // points at the light: its neighbours' corners cover it

    vec2 along = (edge.zw - edge.xy) / span;
    vec2 side = vec2(along.y, -along.x);
    vec2 normalA = vertexNormal(camera, leftFirst ? silhouette.a : silhouette.b, side);
    vec2 normalB = vertexNormal(camera, leftFirst ? silhouette.b : silhouette.a, side);
    return SmoothieEdge(edge, vec4(normalA, normalB), nearness, widths);
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= commands.edgeCount) return;
    for (int camera = 0; camera < cameraCount; ++camera) {
        smoothieEdges[uint(camera) * capacity + index] = build(camera, index);
    }
}
