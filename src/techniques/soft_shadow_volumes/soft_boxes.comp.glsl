// SPDX-License-Identifier: Apache-2.0
#version 450
// Boxes around the edges of each word of the list, which are neighbours: tiles that a box does not matter to look at none
// of them.
layout(local_size_x = 64) in;

#include "src/techniques/soft_shadow_volumes/volumes_io.h"

layout(std430) readonly buffer LightEdges { LightEdge lightEdges[]; };
layout(std430) readonly buffer Eye { EyeState eye; };
layout(std430) writeonly buffer WordBoxes { TriangleCluster wordBoxes[]; };

void main() {
    uint word = gl_GlobalInvocationID.x;
    if (word >= wordsOfEdges(eye.edgeCount)) return;
    vec3 low = vec3(3e38), high = vec3(-3e38);
    for (uint i = 32u * word; i < min(32u * word + 32u, eye.edgeCount); ++i) {
        LightEdge edge = lightEdges[i];
        vec3 third = edge.isFace ? edge.planes[0].xyz : edge.aLight;
        low = min(low, min(third, min(edge.aLight, edge.bLight)));
        high = max(high, max(third, max(edge.aLight, edge.bLight)));
    }
    wordBoxes[word] = TriangleCluster(vec4(low, 0.0), vec4(high, 0.0));
}
