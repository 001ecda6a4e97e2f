// SPDX-License-Identifier: Apache-2.0
// What the passes of this room hand to each other; one set of structs for C++ and GLSL (std140, std430).
#ifndef PENUMBRA_VOLUMES_IO_H
#define PENUMBRA_VOLUMES_IO_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
namespace penumbra {
using glm::ivec4;
using glm::mat4;
using glm::uvec4;
using glm::vec4;
using uint = std::uint32_t;
#endif

// Of a flat light's larger half side: what is nearer to its plane is taken to lie in it.
const float inPlane = 1e-4f;

// The light, the eye and the V-buffer as all passes see them, in light space.
struct VolumeConstants {
    // The view's, shifted so that texels of the V-buffer lie on the pixels they stand for.
    mat4 clipFromLight;
    // Homogeneous: w = 1 a place, w = 0 the direction towards an orthographic viewer.
    vec4 eyeLight;
    // xy: half width and height, or radius; z: tangent of half a distant light's angle, or z of the plane
    // where a flat light is, if it has been moved; w: the highest caster's z.
    vec4 lightSize;
    // x: LightShape; y: 1 if one-sided; z: 1 if it has no size; w: 1 if it has a radiance texture.
    ivec4 lightKind;
    // xy: the V-buffer's size; z: pixels a texel, along each axis; w: 1 if depth is reversed.
    ivec4 buffer_px;
    // x: small tiles a row; y: large tiles a row; z: small tiles along a large one; w: words a list.
    ivec4 tiles;
};

// An edge with one or two of its faces, in light space; an edge of more faces is several of these, whose
// weights add. A face's plane, dotted with (p, 1), is positive where p sees its front, times the direction in
// which the face walks the edge; that of a missing face is 0.
//
// aLight.w, bLight.w: 0; or where the face ends because it cuts through a flat light, the sign of z on the
// side that it is the edge of; or wholeFace: this is no edge but a face that reaches into a sphere, with
// corners aLight, bLight and planes[0], in the plane planes[1].
struct LightEdge {
    vec4 aLight;
    vec4 bLight;
    vec4 planes[2];
};

// A triangle in light space, and its plane as of LightEdge, for the way in which it is wound. A plane of 0:
// the triangle hides nothing from the light's centre.
struct LightTriangle {
    vec4 a;
    vec4 b;
    vec4 c;
    vec4 plane;
};

// How many of them make a cluster, and so many clusters a group of center_counts.comp.glsl goes through: were it to look at
// each of their triangles, a software rasterizer would still do all that it is asked (README.md, "Rounds").
const uint clusterTriangles = 32u;
const uint clustersAtOnce = 1024u;

// Around a cluster. low.x > high.x: nothing of it hides anything.
struct TriangleCluster {
    vec4 low;
    vec4 high;
};

// What is known about the eye, and how the volumes are drawn.
struct EyeState {
    int blockers;        // triangles between the light's centre and the eye
    int unsafe;          // 1 if the eye is too close to the side of a shadow volume for Z-pass
    uint edgeCount;      // light edges gathered
    int blockersBehind;  // and an orthographic view's other end
    uvec4 passSides;     // DrawArraysIndirectCommand
    uvec4 failSides;
    uvec4 wedges;
};

#ifdef __cplusplus
static_assert(sizeof(VolumeConstants) == 144 && sizeof(LightEdge) == 64 && sizeof(EyeState) == 64);
static_assert(sizeof(LightTriangle) == 64 && sizeof(TriangleCluster) == 32);
}  // namespace penumbra
#else
const float wholeFace = 2.0;
const int shapeRect = 0, shapeDisk = 1, shapeSphere = 2, shapeDistant = 3;
layout(std140, binding = 1) uniform VolumeBlock {
    VolumeConstants volume;
};

// How many words of edges there are to look at: none if they did not all fit, since half of the edges are
// worse than the shadow of the light's centre.
uint wordsOfEdges(uint edgeCount) {
    uint words = (edgeCount + 31u) / 32u;
    return words <= uint(volume.tiles.w) ? words : 0u;
}

// An order of places that all who ask about an edge agree on.
bool isBefore(vec3 a, vec3 b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; }

// From the light's centre through a point: the direction in which the point's shadow falls.
vec3 shadowDirection(vec3 posLight) {
    return volume.lightKind.x == shapeDistant ? vec3(0.0, 0.0, -1.0) : posLight;
}

// On which side of the plane through the light's centre and the edge a homogeneous point lies.
float sideOfEdge(vec3 aLight, vec3 bLight, vec4 posLight) {
    return dot(cross(shadowDirection(aLight), bLight - aLight), posLight.xyz - posLight.w * aLight);
}
#endif
#endif
