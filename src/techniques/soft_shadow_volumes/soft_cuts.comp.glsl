// SPDX-License-Identifier: Apache-2.0
#version 450
// Triangles that cut through the light.
//
// A flat one: a triangle hides what it hides with the part on the receiver's side of the light's plane. That part ends in
// the cut: an edge of this face alone, in the light itself.
//
// A sphere: a triangle ends where it goes into the ball, in a curve that is no edge. So it goes into the list whole, and
// receivers ask each point of the light about it (addFace in layer_counts.glsl).
layout(local_size_x = 256) in;

#include "src/techniques/soft_shadow_volumes/volumes_io.h"
#include "src/techniques/soft_shadow_volumes/mesh_faces.glsl"
#include "src/techniques/soft_shadow_volumes/gathering.glsl"

// The part strictly on the side where z has this sign, walked as the face is, leaves through the plane at `from` and comes
// back at `to`.
void gatherCut(vec3 corners[3], vec4 plane, float side) {
    vec3 from, to;
    int crossings = 0;
    for (int i = 0; i < 3; ++i) {
        vec3 a = corners[i], b = corners[(i + 1) % 3];
        bool hasA = side * a.z > 0.0, hasB = side * b.z > 0.0;
        if (hasA == hasB) continue;
        if (hasA) from = cutPoint(a, b);
        else to = cutPoint(a, b);
        ++crossings;
    }
    if (crossings < 2) return;
    // Beside the light?
    vec2 low = min(from.xy, to.xy), high = max(from.xy, to.xy), size = volume.light.halfSize;
    if (any(greaterThan(low, size)) || any(lessThan(high, -size))) return;
    gatherEdge(from, to, side, vec4[2](plane, vec4(0.0)));
}

void gatherCuts() {
    uint triangle = gl_GlobalInvocationID.x;
    if (triangle >= mesh.count) return;
    vec3 corners[3];
    for (uint i = 0u; i < 3u; ++i) corners[i] = positionLight(indices[3u * triangle + i]);
    // What collapses has no edges either.
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) return;
    vec4 plane = facePlane(2u * triangle);
    if (volume.light.shape == shapeSphere) {
        if (mayReachIntoSphere(2u * triangle))
            gather(LightEdge(corners[0], 0.0, corners[1], true, vec4[2](vec4(corners[2], 0.0), plane)));
        return;
    }
    if (isInLightPlane(2u * triangle)) return;
    gatherCut(corners, plane, -1.0);
    if (!volume.light.isOneSided) gatherCut(corners, plane, 1.0);
}

void main() {
    gatherCuts();
    putGathered();
}
