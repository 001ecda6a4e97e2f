// SPDX-License-Identifier: Apache-2.0
// The faces of a mesh in light space. Requires volumes_io.h.

layout(std430) readonly buffer Positions { float positions[]; };
layout(std430) readonly buffer Indices { uint indices[]; };

// Its matrix has double precision: of a ground that is hundreds of times as large as what stands on it, single precision knows
// no better where it is than receivers are lifted above it.
layout(std140) uniform Constants { MeshConstants mesh; };

dvec3 exactPositionLight(uint vertex) {
    uint i = 3u * vertex;
    precise dvec3 posLight = (mesh.lightFromMesh * dvec4(positions[i], positions[i + 1u], positions[i + 2u], 1.0lf)).xyz;
    return posLight;
}

// The same, to the last bit, in all programs that ask.
vec3 positionLight(uint vertex) { return vec3(exactPositionLight(vertex)); }

// Of how far a face's farthest corner is from the eye: a few times what a rasterizer loses of a place on the face.
const double faceRounding = 2e-6lf;

// The same for all three edges of the face, to the last bit, so that they agree on which side a receiver is. Counted
// from the light's centre: what is lost in rounding grows with how far the receiver is from there, not the face's corners.
// Its value is 1 where receivers are as far from the face as rounding may put those that are on it (see sideOf).
vec4 facePlane(uint face) {
    uint first = 3u * (face >> 1);
    dvec3 a = exactPositionLight(indices[first]);
    precise dvec3 u = exactPositionLight(indices[first + 1u]) - a;
    precise dvec3 v = exactPositionLight(indices[first + 2u]) - a;
    precise dvec3 normal = dvec3(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
    precise double offset = (normal.x * a.x + normal.y * a.y) + normal.z * a.z;
    dvec3 eye = dvec3(volume.eyeLight.w * volume.eyeLight.xyz);
    double farthest = max(length(a - eye), max(length(a + u - eye), length(a + v - eye)));
    precise double one = length(normal) * (faceRounding * farthest);
    vec4 plane = one > 0.0lf ? vec4(vec3(normal / one), float(-offset / one)) : vec4(0.0);
    return (face & 1u) == 0u ? plane : -plane;
}

// Whether a face may reach into a spherical light. The same, to the last bit, for all who ask about this face. More do
// than touch it, by a thousandth at least: for those nothing is lost but time.
bool mayReachIntoSphere(uint face) {
    uint first = 3u * (face >> 1);
    vec3 a = positionLight(indices[first]), b = positionLight(indices[first + 1u]), c = positionLight(indices[first + 2u]);
    float radius = 1.001 * volume.light.halfSize.x;
    bool isBeside = any(greaterThan(min(min(a, b), c), vec3(radius))) || any(lessThan(max(max(a, b), c), vec3(-radius)));
    vec4 plane = facePlane(face);
    precise float square = (plane.x * plane.x + plane.y * plane.y) + plane.z * plane.z;
    return !isBeside && plane.w * plane.w <= radius * radius * square;
}

// Such a face hides nothing of a flat light.
bool isInLightPlane(uint face) {
    uint first = 3u * (face >> 1);
    float a = positionLight(indices[first]).z, b = positionLight(indices[first + 1u]).z,
          c = positionLight(indices[first + 2u]).z;
    return max(abs(a), max(abs(b), abs(c))) <= inPlane * max(volume.light.halfSize.x, volume.light.halfSize.y);
}

// Faces that reach into a sphere are looked at by themselves, and those in a flat light's plane not at all: to edges and
// to the count at the light's centre they are missing. Only meshes whose box meets the light's have any.
bool isMissing(uint face) { return volume.light.shape == shapeSphere ? mayReachIntoSphere(face) : isInLightPlane(face); }
