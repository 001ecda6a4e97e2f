// SPDX-License-Identifier: Apache-2.0
#version 450
// Triangles of a mesh in light space, in clusters with boxes around them. A group does one cluster.
layout(local_size_x = 32) in;

#include "src/techniques/soft_shadow_volumes/volumes_io.h"
#include "src/techniques/soft_shadow_volumes/mesh_faces.glsl"

layout(std430) writeonly buffer Triangles { LightTriangle triangles[]; };
layout(std430) writeonly buffer Clusters { TriangleCluster clusters[]; };

shared vec3 lows[clusterTriangles], highs[clusterTriangles];

void main() {
    uint lane = gl_LocalInvocationIndex, triangle = mesh.firstTriangle + gl_GlobalInvocationID.x;
    uint cluster = mesh.firstCluster + gl_WorkGroupID.x;
    lows[lane] = vec3(3e38);
    highs[lane] = vec3(-3e38);
    vec4 plane = vec4(0.0);
    vec3 a = vec3(0.0), b = a, c = a;
    if (triangle < mesh.count) {
        a = positionLight(indices[3u * triangle]);
        b = positionLight(indices[3u * triangle + 1u]);
        c = positionLight(indices[3u * triangle + 2u]);
        // What collapses has no edges either.
        bool isThere = a != b && b != c && c != a && !(mesh.cutsLight && isMissing(2u * triangle));
        if (isThere) {
            plane = facePlane(2u * triangle);
            lows[lane] = min(a, min(b, c));
            highs[lane] = max(a, max(b, c));
        }
    }
    triangles[cluster * clusterTriangles + lane] = LightTriangle(vec4(a, 0.0), vec4(b, 0.0), vec4(c, 0.0), plane);
    barrier();
    if (lane != 0u) return;
    vec3 low = lows[0], high = highs[0];
    for (uint i = 1u; i < clusterTriangles; ++i) {
        low = min(low, lows[i]);
        high = max(high, highs[i]);
    }
    clusters[cluster] = TriangleCluster(vec4(low, 0.0), vec4(high, 0.0));
}
