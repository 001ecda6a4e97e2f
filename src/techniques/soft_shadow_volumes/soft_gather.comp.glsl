// SPDX-License-Identifier: Apache-2.0
#version 450
// The edges that are silhouettes as seen from anywhere on the light, which is more than its centre sees.
layout(local_size_x = 64) in;

#include "src/techniques/soft_shadow_volumes/volumes_io.h"

struct Edge { uint a, b, firstFace, faceCount; };

layout(std430, binding = 0) readonly buffer Positions { float positions[]; };
layout(std430, binding = 1) readonly buffer Indices { uint indices[]; };
layout(std430, binding = 2) buffer Eye { EyeState eye; };
layout(std430, binding = 3) readonly buffer Edges { Edge edges[]; };
layout(std430, binding = 4) readonly buffer EdgeFaces { uint edgeFaces[]; };
layout(std430, binding = 5) writeonly buffer LightEdges { LightEdge lightEdges[]; };

layout(location = 0) uniform mat4 lightFromMesh;
layout(location = 4) uniform uint edgeCount;

vec3 positionLight(uint vertex) {
    uint i = 3u * vertex;
    return (lightFromMesh * vec4(positions[i], positions[i + 1u], positions[i + 2u], 1.0)).xyz;
}

// The same for all three edges of the face, to the last bit, so that they agree on which side a receiver is.
vec4 facePlane(uint face) {
    uint first = 3u * (face >> 1);
    vec3 a = positionLight(indices[first]);
    precise vec3 u = positionLight(indices[first + 1u]) - a;
    precise vec3 v = positionLight(indices[first + 2u]) - a;
    precise vec3 normal = vec3(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
    precise float offset = (normal.x * a.x + normal.y * a.y) + normal.z * a.z;
    vec4 plane = vec4(normal, -offset);
    return (face & 1u) == 0u ? plane : -plane;
}

// x: what the light's centre sees, y: how far the light's other points can be from that.
vec2 seenByLight(vec4 plane) {
    vec3 size = abs(plane.xyz);
    switch (volume.lightKind.x) {
        case shapeDistant: return vec2(plane.z, volume.lightSize.z * length(plane.xy));
        case shapeSphere: return vec2(plane.w, volume.lightSize.x * length(plane.xyz));
        default: return vec2(plane.w, dot(size.xy, volume.lightSize.xy));
    }
}

void main() {
    if (gl_GlobalInvocationID.x >= edgeCount) return;
    Edge edge = edges[gl_GlobalInvocationID.x];
    vec3 a = positionLight(edge.a), b = positionLight(edge.b);
    // Behind a light that shines to one side only.
    if (volume.lightKind.y == 1 && min(a.z, b.z) >= 0.0) return;
    for (uint i = 0u; i < edge.faceCount; i += 2u) {
        vec4 planes[2];
        bool isSure = true;
        float weight = 0.0;
        for (uint side = 0u; side < 2u; ++side) {
            bool exists = i + side < edge.faceCount;
            planes[side] = exists ? facePlane(edgeFaces[edge.firstFace + i + side]) : vec4(0.0);
            vec2 seen = seenByLight(planes[side]);
            isSure = isSure && (abs(seen.x) > 1.001 * seen.y || !exists);
            weight += sign(seen.x);
        }
        if (isSure && weight == 0.0) continue;
        lightEdges[atomicAdd(eye.edgeCount, 1u)] = LightEdge(vec4(a, 0.0), vec4(b, 0.0), planes);
    }
}
