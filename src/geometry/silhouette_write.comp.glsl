// SPDX-License-Identifier: Apache-2.0
#version 450
// Writes the marked edges into the list, in the order of the mesh's edges.
layout(local_size_x = 256) in;

#include "src/geometry/silhouettes_io.h"
#include "src/geometry/silhouette_block.glsl"

layout(std430) readonly buffer Positions { float positions[]; };
layout(std430) readonly buffer Marks { uint marks[]; };
layout(std430) readonly buffer Offsets { uint offsets[]; };
layout(std430) writeonly buffer Silhouettes { SilhouetteEdge silhouettes[]; };

vec3 positionLight(uint vertex) {
    vec3 posMesh = vec3(positions[3u * vertex], positions[3u * vertex + 1u], positions[3u * vertex + 2u]);
    return (mesh.lightFromMesh * vec4(posMesh, 1.0)).xyz;
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    uint block = mesh.firstBlock + gl_WorkGroupID.x;
    uint word = lane >> 5;
    uint bits = marks[block * wordsPerBlock + word];
    uint bit = 1u << (lane & 31u);
    if ((bits & bit) == 0u) return;
    uint rank = offsets[block] + uint(bitCount(bits & (bit - 1u)));
    for (uint i = 0u; i < word; ++i) rank += uint(bitCount(marks[block * wordsPerBlock + i]));
    Edge edge = edges[gl_GlobalInvocationID.x];
    silhouettes[rank] = SilhouetteEdge(positionLight(edge.a), silhouetteWeight(edge), positionLight(edge.b), mesh.caster,
                                       mesh.firstVertex + edge.a, mesh.firstVertex + edge.b, 0u, 0u);
}
