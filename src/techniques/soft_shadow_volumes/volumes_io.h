// SPDX-License-Identifier: Apache-2.0
// What the passes of this room hand to each other; one set of structs for C++ and GLSL (std140, std430).
#ifndef PENUMBRA_VOLUMES_IO_H
#define PENUMBRA_VOLUMES_IO_H

#include "src/techniques/common/light_io.h"

#ifdef __cplusplus
namespace penumbra::soft_shadow_volumes {
using glm::dmat4;
#endif

// Of a flat light's larger half side: what is nearer to its plane is taken to lie in it.
const float inPlane = 1e-4f;

// The light, the eye and the V-buffer as all passes see them, in light space.
SHARED_STRUCT VolumeConstants {
    mat4
        clipFromLight;  // the view's, shifted so that texels of the V-buffer lie on the pixels they stand for
    vec4 eyeLight;      // homogeneous: w = 1 a place, w = 0 the direction towards an orthographic viewer
    LightConstants light;
    ivec2 buffer_px;        // the V-buffer's size
    int pixelsPerTexel;     // along each axis
    bool32 isReversed;      // depth is: nearer is more
    uint smallTilesAcross;  // a row of them
    uint largeTilesAcross;
    uint smallTilesALargeOne;  // along each of its sides
    uint listWords;            // of a large tile's list of edges
    float highest_m;           // the highest caster's z
    float plane_m;             // z of the plane where a flat light is, if it has been moved
};

// A mesh, and what a pass does with it.
#ifdef __cplusplus
struct alignas(32)
#else
struct
#endif
    MeshConstants {
    dmat4 lightFromMesh;
    uint count;          // of the edges or triangles that are looked at
    bool32 cutsLight;    // it may cut through the light
    uint firstTriangle;  // that is looked at
    uint firstCluster;   // where its clusters go in the list
    int layersEach;      // a triangle counts for
    float sign;          // 1: what is before the receiver counts; -1: what is behind
    uint unused0;
    uint unused1;
};

// The clusters that have been listed, and the mask of the caster to which they belong.
SHARED_STRUCT ClusterConstants {
    uint count;
    bool32 toCenter;     // listed are those on the way to the light's centre, not to all of it
    uint firstTriangle;  // of the mesh, that the list begins with
    float alphaFactor;
    float alphaCutoff;
};

SHARED_STRUCT ResolveConstants {
    uint firstTile;  // of the band that is worked on
    uint round;
    uint roundWork;  // loop iterations after which a tile pauses
    uint thisList;   // where this round's list of tiles begins
    uint nextList;   // and the next one's
    bool32 hasMasks;
};

SHARED_STRUCT CountingConstants {
    uint casterCount;
    int counting;  // 0: Z-pass where it is safe; 1: Z-pass; 2: Z-fail
    bool32 hasEdges;
    bool32 mayHide;  // there may be triangles before the receivers that the picture does not show
};

SHARED_STRUCT SidesConstants {
    float sign;  // as of MeshConstants
};

SHARED_STRUCT UpsampleConstants {
    bool32 byPoint;  // pixels take from the texel that they lie in
};

SHARED_STRUCT PointsConstants {
    int count;
};

SHARED_STRUCT WedgeConstants {
    int half_;  // 0: the whole; 1, -1: the half on one or the other side of the middle plane
    int eye;    // 0: all; 1, -1: only if the eye may be in the (half) wedge, or cannot be
};

// An edge with one or two of its faces, in light space; an edge of more faces is several of these, whose
// weights add. A face's plane, dotted with (p, 1), is positive where p sees its front, times the direction in
// which the face walks the edge, and within 1 of 0 where rounding decides; that of a missing face is 0.
//
// isFace: this is no edge but a face that reaches into a sphere, with corners aLight, bLight and planes[0],
// in the plane planes[1].
struct LightEdge {
    vec3 aLight;
    float cutSide;  // where its face ends because it cuts through a flat light: the sign of z there; else 0
    vec3 bLight;
    bool32 isFace;
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

// How many of them make a cluster, and so many clusters a group of center_counts.comp.glsl goes through: were
// it to look at each of their triangles, a software rasterizer would still do all that it is asked
// (README.md, "Rounds").
const uint clusterTriangles = 32u;
const uint clustersAtOnce = 1024u;

// Around a cluster of triangles or a word of edges. low.x > high.x: nothing of it hides anything.
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
static_assert(sizeof(VolumeConstants) == 160 && sizeof(MeshConstants) == 160 && sizeof(LightEdge) == 64 &&
              sizeof(EyeState) == 64);
static_assert(sizeof(LightTriangle) == 64 && sizeof(TriangleCluster) == 32);
}  // namespace penumbra::soft_shadow_volumes
#else
layout(std140) uniform VolumeBlock {
    VolumeConstants volume;
};

// How many words of edges there are to look at: none if they did not all fit, since half of the edges are
// worse than the shadow of the light's centre.
uint wordsOfEdges(uint edgeCount) {
    uint words = (edgeCount + 31u) / 32u;
    return words <= volume.listWords ? words : 0u;
}

// An order of places that all who ask about an edge agree on.
bool isBefore(vec3 a, vec3 b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

// How far a receiver is from a face's plane, as computed.
float distanceOf(vec4 plane, vec3 posLight) {
    precise float side = ((plane.x * posLight.x + plane.y * posLight.y) + plane.z * posLight.z) + plane.w;
    return side;
}

// On which side of a face, by its plane, a receiver is. Where that is lost in rounding, as it is of its own
// face, where the eye is that sees it there.
float sideOf(vec4 plane, vec3 posLight) {
    float side = distanceOf(plane, posLight);
    precise vec4 ofEye = plane * volume.eyeLight;
    return sign(abs(side) > 1.0 ? side : ((ofEye.x + ofEye.y) + ofEye.z) + ofEye.w);
}

// From the light's centre through a point: the direction in which the point's shadow falls.
vec3 shadowDirection(vec3 posLight) {
    return volume.light.shape == shapeDistant ? vec3(0.0, 0.0, -1.0) : posLight;
}

// On which side of the plane through the light's centre and the edge a homogeneous point lies.
float sideOfEdge(vec3 aLight, vec3 bLight, vec4 posLight) {
    return dot(cross(shadowDirection(aLight), bLight - aLight), posLight.xyz - posLight.w * aLight);
}
#endif
#endif
