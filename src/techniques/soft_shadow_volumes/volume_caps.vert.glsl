// SPDX-License-Identifier: Apache-2.0
#version 450
// Every triangle closes its own shadow at the near end (instance 0) and at infinity (instance 1).
#include "src/techniques/soft_shadow_volumes/volumes_io.h"

layout(std430, binding = 0) readonly buffer Positions { float positions[]; };
layout(std430, binding = 1) readonly buffer Indices { uint indices[]; };
layout(location = 0) uniform mat4 lightFromMesh;
layout(location = 4) uniform int layersEach;
layout(location = 5) uniform float sign;  // as for sides
layout(location = 0) flat out float change;

// A near cap is moved away from the eye by this share of its distance: a receiver is the side of the surface that the
// eye sees, so that its own cap lies behind it.
const float fromEye = 2e-5;

vec3 cornerLight(uint index) {
    uint i = 3u * indices[index];
    return (lightFromMesh * vec4(positions[i], positions[i + 1u], positions[i + 2u], 1.0)).xyz;
}

void main() {
    // Drawn without an index buffer: three vertices a triangle.
    uint first = uint(gl_VertexID) / 3u * 3u;
    vec3 a = cornerLight(first), b = cornerLight(first + 1u), c = cornerLight(first + 2u);
    vec3 place = gl_VertexID % 3 == 0 ? a : gl_VertexID % 3 == 1 ? b : c;
    if (gl_InstanceID == 1) {
        gl_Position = volume.clipFromLight * vec4(shadowDirection(place), 0.0);
        change = float(layersEach);
        return;
    }
    vec3 normal = cross(b - a, c - a);
    float ofEye = dot(normal, volume.eyeLight.xyz - volume.eyeLight.w * a);
    float ofLight = volume.lightKind.x == shapeDistant ? normal.z : -dot(normal, a);
    change = sign * float(ofEye * ofLight >= 0.0 ? layersEach : -layersEach);
    vec3 toEye = volume.eyeLight.w == 0.0 ? volume.eyeLight.xyz * length(place) : volume.eyeLight.xyz - place;
    gl_Position = volume.clipFromLight * vec4(place - fromEye * toEye, 1.0);
}
