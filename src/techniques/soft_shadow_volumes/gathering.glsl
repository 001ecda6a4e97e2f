// SPDX-License-Identifier: Apache-2.0
// Edges of a mesh, written down in light space. Requires mesh_faces.glsl.

layout(std430) buffer Eye { EyeState eye; };
layout(std430) writeonly buffer LightEdges { LightEdge lightEdges[]; };

// Edges for which there is no room are counted all the same.
void gather(LightEdge edge) {
    uint place = atomicAdd(eye.edgeCount, 1u);
    if (place < 32u * volume.listWords) lightEdges[place] = edge;
}

// From the end that comes first, so that an edge is asked the same question as the sides of its faces are.
void gatherEdge(vec4 a, vec4 b, vec4 planes[2]) {
    if (isBefore(a.xyz, b.xyz)) gather(LightEdge(a, b, planes));
    else gather(LightEdge(b, a, vec4[2](-planes[0], -planes[1])));
}

// Where an edge whose ends lie on different sides meets the plane of a flat light. The same, to the last bit, for all
// who ask about this edge, so that what they cut fits together.
vec3 cutPoint(vec3 a, vec3 b) {
    bool isOrdered = isBefore(a, b);
    vec3 from = isOrdered ? a : b, to = isOrdered ? b : a;
    precise float share = from.z / (from.z - to.z);
    precise vec2 place = from.xy * (1.0 - share) + to.xy * share;
    return vec3(place, 0.0);
}
