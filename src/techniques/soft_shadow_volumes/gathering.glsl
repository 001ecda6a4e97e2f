// SPDX-License-Identifier: Apache-2.0
// Edges of a mesh in light space. Requires volumes_io.h.

layout(std430, binding = 0) readonly buffer Positions { float positions[]; };
layout(std430, binding = 1) readonly buffer Indices { uint indices[]; };
layout(std430, binding = 2) buffer Eye { EyeState eye; };
layout(std430, binding = 5) writeonly buffer LightEdges { LightEdge lightEdges[]; };

layout(location = 0) uniform mat4 lightFromMesh;

// The same, to the last bit, in all programs that ask.
vec3 positionLight(uint vertex) {
    uint i = 3u * vertex;
    precise vec3 posLight = (lightFromMesh * vec4(positions[i], positions[i + 1u], positions[i + 2u], 1.0)).xyz;
    return posLight;
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

// Edges for which there is no room are counted all the same.
void gather(LightEdge edge) {
    uint place = atomicAdd(eye.edgeCount, 1u);
    if (place < 32u * uint(volume.tiles.w)) lightEdges[place] = edge;
}

// Whether a face may reach into a spherical light. The same, to the last bit, for all who ask about this face. More do
// than touch it, by a thousandth at least: for those nothing is lost but time.
bool mayReachIntoSphere(uint face) {
    uint first = 3u * (face >> 1);
    vec3 a = positionLight(indices[first]), b = positionLight(indices[first + 1u]), c = positionLight(indices[first + 2u]);
    float radius = 1.001 * volume.lightSize.x;
    bool isBeside = any(greaterThan(min(min(a, b), c), vec3(radius))) || any(lessThan(max(max(a, b), c), vec3(-radius)));
    vec4 plane = facePlane(face);
    precise float square = (plane.x * plane.x + plane.y * plane.y) + plane.z * plane.z;
    return !isBeside && plane.w * plane.w <= radius * radius * square;
}

// Where an edge whose ends lie on different sides meets the plane of a flat light. The same, to the last bit, for all
// who ask about this edge, so that what they cut fits together.
vec3 cutPoint(vec3 a, vec3 b) {
    bool isOrdered = a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
    vec3 from = isOrdered ? a : b, to = isOrdered ? b : a;
    precise float share = from.z / (from.z - to.z);
    precise vec2 place = from.xy * (1.0 - share) + to.xy * share;
    return vec3(place, 0.0);
}
