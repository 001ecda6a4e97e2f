// SPDX-License-Identifier: Apache-2.0
#version 450
// Counts the triangles of a mesh between the light's centre and the eye: what Z-pass starts from. An
// orthographic view's eye is infinitely far, and so is, seen the other way, what Z-fail starts from.
layout(local_size_x = 256) in;

#include "src/techniques/soft_shadow_volumes/volumes_io.h"
#include "src/techniques/soft_shadow_volumes/mesh_faces.glsl"

layout(std430) buffer Eye { EyeState eye; };

// The same for both faces of an edge, so that the eye is never on both sides of it, or on neither.
bool isLeft(vec3 a, vec3 b, vec4 point) {
    return isBefore(a, b) ? sideOfEdge(a, b, point) >= 0.0 : !(sideOfEdge(b, a, point) >= 0.0);
}

// Whether the triangle lies between the light's centre and a homogeneous point.
bool isBetween(vec3 a, vec3 b, vec3 c, vec4 plane, vec4 point) {
    bool left = isLeft(a, b, point);
    if (left != isLeft(b, c, point) || left != isLeft(c, a, point)) return false;
    float ofPoint = dot(plane, point);
    float ofLight = volume.light.shape == shapeDistant ? plane.z : plane.w;
    return sign(ofPoint) * sign(ofLight) < 0.0;
}

void main() {
    uint triangle = gl_GlobalInvocationID.x;
    if (triangle >= mesh.count) return;
    vec3 a = positionLight(indices[3u * triangle]), b = positionLight(indices[3u * triangle + 1u]),
         c = positionLight(indices[3u * triangle + 2u]);
    if (a == b || b == c || c == a) return;
    vec4 plane = facePlane(2u * triangle);
    if (isBetween(a, b, c, plane, volume.eyeLight)) atomicAdd(eye.blockers, mesh.layersEach);
    if (volume.eyeLight.w == 0.0 && isBetween(a, b, c, plane, -volume.eyeLight))
        atomicAdd(eye.blockersBehind, mesh.layersEach);
}
