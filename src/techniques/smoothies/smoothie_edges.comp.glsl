// SPDX-License-Identifier: Apache-2.0
#version 450
// Chan and Durand 2003, section 3, step 3: where the smoothie of each silhouette edge goes, for each light camera, and
// how wide it must be. The paper foresees vertex stages that read the shadow map to size the smoothies (section 3.1).
layout(local_size_x = 64) in;

#include "src/techniques/smoothies/smoothies.glsl"
#include "src/geometry/silhouettes_io.h"
#include "src/techniques/smoothies/smoothie_edges_io.h"

layout(std430) readonly buffer Tiles { float farthestNearness[]; };
layout(std430) readonly buffer Silhouettes { SilhouetteEdge silhouettes[]; };
layout(std430) readonly buffer Commands { SilhouetteCommands commands; };
layout(std430) readonly buffer VertexNormals { ivec4 vertexNormals[]; };
layout(std430) writeonly buffer SmoothieEdges { SmoothieEdge smoothieEdges[]; };

layout(std140) uniform Constants { ConstructionConstants construction; };

// Moves the segment's ends to where f, linear between its values at both ends, becomes positive. False: nowhere.
bool clip(inout vec2 segment, float fa, float fb) {
    if (fa < 0.0 && fb < 0.0) return false;
    if (fa < 0.0) segment.x = max(segment.x, fa / (fa - fb));
    if (fb < 0.0) segment.y = min(segment.y, fa / (fa - fb));
    return segment.x < segment.y;
}

// The widest that the smoothie of an edge can be at both ends, above a surface at nearness `receiver`. Between them it is
// no wider than in proportion.
vec2 largestWidths(int camera, vec2 placeA, vec2 placeB, vec2 blocker, float receiver) {
    // The light's image lies within a box, whose corner is the farthest in any direction. The ends bound it in between: it
    // is convex in the place.
    vec2 half_m;
    for (int i = 0; i < 2; ++i) {
        vec2 place = i == 0 ? placeA : placeB;
        half_m[i] = length(vec2(lightExtent(camera, place, vec2(1.0, 0.0)).half_m,
                                lightExtent(camera, place, vec2(0.0, 1.0)).half_m));
    }
    float largest = max(half_m.x, half_m.y);
    vec2 widths =
        vec2(smoothieWidth(camera, largest, blocker.x, receiver), smoothieWidth(camera, largest, blocker.y, receiver));
    // Widths are linear in nearness, which is linear along the edge, unless they are the paper's t or cut off.
    float widest = max(widths.x, widths.y);
    bool linear = smoothies[camera].fixedWidth == 0.0 && widest < smoothies[camera].largestWidth;
    return linear ? widths : vec2(widest);
}

// No wider at either end than the farthest surface within reach asks for. What lies hidden behind the blocker is taken to
// be no farther than what shows around it.
vec2 boundByReceivers(int camera, vec2 placeA, vec2 placeB, vec2 nearness, vec2 widths) {
    for (int i = 0; i < 2; ++i) {
        float reach = max(widths.x, widths.y);
        vec2 low = min(placeA, placeB) - reach, high = max(placeA, placeB) + reach;
        ivec2 first = texelOf(camera, low, tilesAcross), last = texelOf(camera, high, tilesAcross);
        ivec2 count = last - first + 1;
        if (count.x * count.y > 256) return widths;
        float farthest = smoothies[camera].nearestDrawn;
        for (int y = first.y; y <= last.y; ++y) {
            for (int x = first.x; x <= last.x; ++x) {
                farthest = min(farthest, farthestNearness[(camera * tilesAcross + y) * tilesAcross + x]);
            }
        }
        widths = min(widths, largestWidths(camera, placeA, placeB, nearness, farthest));
    }
    return widths;
}

// The mean of the outward normals at a vertex, in the window. Normals of edges through a vertex are kept as the planes
// that they span with the light, all of which hold the ray through the vertex. Where edges cancel (the tip of a
// needle), the corner is rounded by a quarter at each.
vec2 vertexNormal(int camera, uint vertex, vec2 side) {
    vec2 normal = (mat3(smoothies[camera].camera.faceFromLight) * vec3(vertexNormals[vertex].xyz)).xy;
    float size = length(normal);
    // Fixed point leaves some 1e-5 of direction; a mean that points away from this edge would need more than a quarter.
    if (size < 1e-3 * vertexNormalScale) return vec2(0.0);
    normal /= size;
    return dot(normal, side) > -0.5 ? normal : vec2(0.0);
}

// A place in the window, times what it is to be divided by.
vec3 homogeneous(int camera, vec3 posFace) { return isOrthographic(camera) ? vec3(posFace.xy, 1.0) : posFace; }

// Cuts off what lies farther than `reach` outside the window. False: all of it. Done before the division by depth, which
// puts an end that is close to the light's plane so far away that nothing in the window keeps its precision.
bool clipToWindow(int camera, float reach, inout vec3 a, inout vec3 b) {
    MapWindow window = smoothies[camera].camera.window;
    vec2 low = window.min - reach, high = window.min + 1.0 / window.perExtent + reach;
    vec3 ha = homogeneous(camera, a), hb = homogeneous(camera, b);
    vec2 segment = vec2(0.0, 1.0);
    for (int i = 0; i < 2; ++i) {
        if (!clip(segment, ha[i] - low[i] * ha.z, hb[i] - low[i] * hb.z)) return false;
        if (!clip(segment, high[i] * ha.z - ha[i], high[i] * hb.z - hb[i])) return false;
    }
    vec3 step3 = b - a;
    b = a + segment.y * step3;
    a += segment.x * step3;
    return true;
}

SmoothieEdge build(int camera, uint index) {
    SmoothieEdge nothing = SmoothieEdge(vec4(0.0), vec4(0.0), vec2(0.0), vec2(0.0));
    SilhouetteEdge silhouette = silhouettes[index];
    SmoothieConstants c = smoothies[camera];
    bool leftFirst = silhouette.weight > 0;
    vec3 a = (c.camera.faceFromLight * vec4(leftFirst ? silhouette.aLight : silhouette.bLight, 1.0)).xyz;
    vec3 b = (c.camera.faceFromLight * vec4(leftFirst ? silhouette.bLight : silhouette.aLight, 1.0)).xyz;

    // Only what lies before the farthest receiver and in front of the camera has a place.
    float farthest = c.farthestReceiver;
    float nearest_m = isOrthographic(camera) ? -c.nearestDrawn : 1.0 / c.nearestDrawn;
    vec2 segment = vec2(0.0, 1.0);
    if (!clip(segment, a.z - nearest_m, b.z - nearest_m)) return nothing;
    vec3 step3 = b - a;
    b = a + segment.y * step3;
    a += segment.x * step3;
    if (max(nearnessOf(camera, a.z), nearnessOf(camera, b.z)) <= farthest) return nothing;

    // The part of the edge whose smoothie reaches into the window.
    vec2 placeA, placeB, nearness, widths;
    float reach = c.largestWidth;
    for (int i = 0; i < 2; ++i) {
        if (!clipToWindow(camera, reach, a, b)) return nothing;
        vec3 ha = homogeneous(camera, a), hb = homogeneous(camera, b);
        placeA = ha.xy / ha.z;
        placeB = hb.xy / hb.z;
        nearness = vec2(nearnessOf(camera, a.z), nearnessOf(camera, b.z));
        widths = largestWidths(camera, placeA, placeB, nearness, farthest);
        reach = max(widths.x, widths.y);
    }
    widths = boundByReceivers(camera, placeA, placeB, nearness, widths);
    float span = distance(placeA, placeB);
    if (!(span > 1e-6 * c.camera.depth.texelSize)) return nothing;  // points at the light: its neighbours' corners cover it

    vec2 along = (placeB - placeA) / span;
    vec2 side = vec2(along.y, -along.x);
    vec2 normalA = vertexNormal(camera, leftFirst ? silhouette.a : silhouette.b, side);
    vec2 normalB = vertexNormal(camera, leftFirst ? silhouette.b : silhouette.a, side);
    return SmoothieEdge(vec4(placeA, placeB), vec4(normalA, normalB), nearness, widths);
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= commands.edgeCount) return;
    for (int camera = 0; camera < construction.cameraCount; ++camera) {
        smoothieEdges[uint(camera) * construction.capacity + index] = build(camera, index);
    }
}
