// SPDX-License-Identifier: Apache-2.0
#version 450
// Counts the triangles of a mesh between the light's centre and the eye: what Z-pass starts from. An
// orthographic view's eye is infinitely far, and so is, seen the other way, what Z-fail starts from.
layout(local_size_x = 256) in;

#include "src/techniques/soft_shadow_volumes/volumes_io.h"

layout(std430, binding = 0) readonly buffer Positions { float positions[]; };
layout(std430, binding = 1) readonly buffer Indices { uint indices[]; };
layout(std430, binding = 2) buffer Eye { EyeState eye; };

layout(location = 0) uniform mat4 lightFromMesh;
layout(location = 4) uniform uint triangleCount;
layout(location = 5) uniform int layersEach;

vec3 cornerLight(uint index) {
    uint i = 3u * indices[index];
    return (lightFromMesh * vec4(positions[i], positions[i + 1u], positions[i + 2u], 1.0)).xyz;
}

// The same for both faces of an edge, so that the eye is never on both sides of it, or on neither.
bool isLeft(vec3 a, vec3 b, vec4 point) {
    return isBefore(a, b) ? sideOfEdge(a, b, point) >= 0.0 : !(sideOfEdge(b, a, point) >= 0.0);
}

// Whether the triangle lies between the light's centre and a homogeneous point.
bool isBetween(vec3 a, vec3 b, vec3 c, vec4 point) {
    bool left = isLeft(a, b, point);
    if (left != isLeft(b, c, point) || left != isLeft(c, a, point)) return false;
    vec3 normal = cross(b - a, c - a);
    float ofPoint = dot(normal, point.xyz - point.w * a);
    float ofLight = volume.lightKind.x == shapeDistant ? normal.z : -dot(normal, a);
    return ofPoint * ofLight < 0.0;
}

void main() {
    uint triangle = gl_GlobalInvocationID.x;
    if (triangle >= triangleCount) return;
    vec3 a = cornerLight(3u * triangle), b = cornerLight(3u * triangle + 1u), c = cornerLight(3u * triangle + 2u);
    if (a == b || b == c || c == a) return;
    if (isBetween(a, b, c, volume.eyeLight)) atomicAdd(eye.blockers, layersEach);
    if (volume.eyeLight.w == 0.0 && isBetween(a, b, c, -volume.eyeLight)) atomicAdd(eye.blockersBehind, layersEach);
}
