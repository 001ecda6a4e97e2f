// SPDX-License-Identifier: Apache-2.0
// Edges of a mesh, written down in light space. Requires mesh_faces.glsl.

layout(std430) buffer Eye { EyeState eye; };
layout(std430) writeonly buffer LightEdges { LightEdge lightEdges[]; };

const uint mostOwn = 4u;
LightEdge own[mostOwn];
uint ownCount = 0u;

// Edges for which there is no room are counted all the same.
void put(uint place, LightEdge edge) {
    if (place < 32u * volume.listWords) lightEdges[place] = edge;
}

// Few invocations have more than one or two.
void gather(LightEdge edge) {
    if (ownCount < mostOwn) own[ownCount++] = edge;
    else put(atomicAdd(eye.edgeCount, 1u), edge);
}

shared uint groupCount, groupFirst;

// For all invocations of a group, at the end: what they have gathered goes side by side, so that words of the list
// (soft_boxes.comp.glsl) hold neighbours on the mesh.
void putGathered() {
    bool isFirst = gl_LocalInvocationIndex == 0u;
    if (isFirst) groupCount = 0u;
    barrier();
    uint place = ownCount > 0u ? atomicAdd(groupCount, ownCount) : 0u;
    barrier();
    if (isFirst && groupCount > 0u) groupFirst = atomicAdd(eye.edgeCount, groupCount);
    barrier();
    for (uint i = 0u; i < ownCount; ++i) put(groupFirst + place + i, own[i]);
}

// From the end that comes first, so that an edge is asked the same question as the sides of its faces are.
void gatherEdge(vec3 a, vec3 b, float cutSide, vec4 planes[2]) {
    if (isBefore(a, b)) gather(LightEdge(a, cutSide, b, false, planes));
    else gather(LightEdge(b, cutSide, a, false, vec4[2](-planes[0], -planes[1])));
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
