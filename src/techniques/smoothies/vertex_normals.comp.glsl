// SPDX-License-Identifier: Apache-2.0
#version 450
// Chan and Durand 2003, section 3, step 3: the shared normal of the silhouette edges that meet at a vertex. Kept in
// fixed point, whose sums do not depend on the order in which edges arrive. Variants: CLEAR, for the first step.
layout(local_size_x = 64) in;

#include "src/geometry/silhouettes_io.h"
#include "src/techniques/smoothies/smoothie_edges_io.h"
#include "src/techniques/smoothies/smoothies_io.h"

layout(std430) readonly buffer Silhouettes { SilhouetteEdge silhouettes[]; };
layout(std430) readonly buffer Commands { SilhouetteCommands commands; };
layout(std430) buffer VertexNormals { ivec4 vertexNormals[]; };

#ifndef CLEAR
layout(std140) uniform Constants { ConstructionConstants construction; };
#endif

void main() {
    uint edge = gl_GlobalInvocationID.x;
    if (edge >= commands.edgeCount) return;
    SilhouetteEdge silhouette = silhouettes[edge];
#ifdef CLEAR
    vertexNormals[silhouette.a] = ivec4(0);
    vertexNormals[silhouette.b] = ivec4(0);
#else
    // The plane through the light and the edge, its normal on the side where the blocker is not.
    vec3 along = silhouette.bLight - silhouette.aLight;
    vec3 normal = cross(construction.isDistant ? vec3(0.0, 0.0, -1.0) : silhouette.aLight, along);
    float size = length(normal);
    if (!(size > 0.0)) return;  // the edge points at the light
    normal *= (silhouette.weight > 0 ? vertexNormalScale : -vertexNormalScale) / size;
    for (int i = 0; i < 3; ++i) {
        atomicAdd(vertexNormals[silhouette.a][i], int(round(normal[i])));
        atomicAdd(vertexNormals[silhouette.b][i], int(round(normal[i])));
    }
#endif
}
