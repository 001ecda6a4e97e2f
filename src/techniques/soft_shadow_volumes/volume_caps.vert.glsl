// SPDX-License-Identifier: Apache-2.0
#version 450
// Every triangle closes its own shadow at the near end (instance 0) and at infinity (instance 1).
#include "src/techniques/soft_shadow_volumes/volumes_io.h"

layout(std430) readonly buffer Positions { float positions[]; };
layout(std430) readonly buffer Indices { uint indices[]; };
layout(std140) uniform Constants { MeshConstants mesh; };
layout(location = 0) flat out float change;

// A near cap is moved away from the eye by this share of its distance: a receiver is the side of the surface that the
// eye sees, so that its own cap lies behind it. And by no less than rounding moves a plane whose corners are far away, a
// ground's for instance, of which the eye sees what lies before its feet: by this share of how far the corners are.
const float fromEye = 2e-5, ofCorners = 2e-6;
const float mostFromEye = 0.1;  // of a plane that is all but seen edge-on

vec3 cornerLight(uint index) {
    uint i = 3u * indices[index];
    return (mat4(mesh.lightFromMesh) * vec4(positions[i], positions[i + 1u], positions[i + 2u], 1.0)).xyz;
}

void main() {
    // Drawn without an index buffer: three vertices a triangle.
    uint first = uint(gl_VertexID) / 3u * 3u;
    vec3 a = cornerLight(first), b = cornerLight(first + 1u), c = cornerLight(first + 2u);
    vec3 place = gl_VertexID % 3 == 0 ? a : gl_VertexID % 3 == 1 ? b : c;
    if (gl_InstanceID == 1) {
        gl_Position = volume.clipFromLight * vec4(shadowDirection(place), 0.0);
        change = float(mesh.layersEach);
        return;
    }
    vec3 normal = cross(b - a, c - a);
    float ofEye = dot(normal, volume.eyeLight.xyz - volume.eyeLight.w * a);
    float ofLight = volume.light.shape == shapeDistant ? normal.z : -dot(normal, a);
    change = mesh.sign * float(ofEye * ofLight >= 0.0 ? mesh.layersEach : -mesh.layersEach);
    if (volume.eyeLight.w == 0.0) {
        gl_Position = volume.clipFromLight * vec4(place - fromEye * length(place) * volume.eyeLight.xyz, 1.0);
        return;
    }
    // All of a triangle's corners are moved by the same share, so that it stays a plane, and parallel.
    float corners_m = sqrt(max(dot(a, a), max(dot(b, b), dot(c, c))));
    float height_m = abs(ofEye) / length(normal);
    float share = min(max(fromEye, ofCorners * corners_m / height_m), mostFromEye);
    gl_Position = volume.clipFromLight * vec4(place + share * (place - volume.eyeLight.xyz), 1.0);
}
