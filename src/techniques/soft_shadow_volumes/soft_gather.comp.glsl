// SPDX-License-Identifier: Apache-2.0
#version 450
// The edges that are silhouettes as seen from anywhere on the light, which is more than its centre sees.
layout(local_size_x = 256) in;

#include "src/techniques/soft_shadow_volumes/volumes_io.h"
#include "src/techniques/soft_shadow_volumes/mesh_faces.glsl"
#include "src/techniques/soft_shadow_volumes/gathering.glsl"

struct Edge { uint a, b, firstFace, faceCount; };

layout(std430) readonly buffer Edges { Edge edges[]; };
layout(std430) readonly buffer EdgeFaces { uint edgeFaces[]; };

// x: what the light's centre sees, y: how far the light's other points can be from that.
vec2 seenByLight(vec4 plane) {
    vec3 size = abs(plane.xyz);
    switch (volume.light.shape) {
        case shapeDistant: return vec2(plane.z, volume.light.halfSize.x * length(plane.xy));
        case shapeSphere: return vec2(plane.w, volume.light.halfSize.x * length(plane.xyz));
        default: return vec2(plane.w, dot(size.xy, volume.light.halfSize));
    }
}

// Gathers what lies strictly on the side of the light's plane where z has this sign.
void gatherSide(vec3 a, vec3 b, vec4 planes[2], float side) {
    bool hasA = side * a.z > 0.0, hasB = side * b.z > 0.0;
    if (!hasA && !hasB) return;
    vec3 from = hasA ? a : cutPoint(a, b), to = hasB ? b : cutPoint(a, b);
    gatherEdge(from, to, 0.0, planes);
}

void gatherEdges() {
    if (gl_GlobalInvocationID.x >= mesh.count) return;
    Edge edge = edges[gl_GlobalInvocationID.x];
    vec3 a = positionLight(edge.a), b = positionLight(edge.b);
    bool isOneSided = volume.light.isOneSided;
    // Behind a light that shines to one side only.
    if (isOneSided && min(a.z, b.z) >= 0.0) return;
    for (uint i = 0u; i < edge.faceCount; i += 2u) {
        vec4 planes[2];
        bool isSure = true;
        float weight = 0.0;
        for (uint side = 0u; side < 2u; ++side) {
            bool exists = i + side < edge.faceCount;
            uint face = exists ? edgeFaces[edge.firstFace + i + side] : 0u;
            exists = exists && !(mesh.cutsLight && isMissing(face));
            planes[side] = exists ? facePlane(face) : vec4(0.0);
            vec2 seen = seenByLight(planes[side]);
            isSure = isSure && (abs(seen.x) > 1.001 * seen.y || !exists);
            weight += sign(seen.x);
        }
        if (isSure && weight == 0.0) continue;
        if (mesh.cutsLight && volume.light.shape != shapeSphere) {
            gatherSide(a, b, planes, -1.0);
            if (!isOneSided) gatherSide(a, b, planes, 1.0);
        } else {
            gatherEdge(a, b, 0.0, planes);
        }
    }
}

void main() {
    gatherEdges();
    putGathered();
}
