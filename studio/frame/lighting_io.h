// SPDX-License-Identifier: Apache-2.0
// A light as the lighting pass sees it; one struct for C++ and GLSL (std140).
#ifndef PENUMBRA_LIGHTING_IO_H
#define PENUMBRA_LIGHTING_IO_H

#include "src/gl/shared_types.h"
#include "studio/frame/light_shapes_io.h"

#ifdef __cplusplus
namespace penumbra::studio {
#endif

const int noProfile = 0;
const int profileTypeA = 1;
const int profileTypeB = 2;
const int profileTypeC = 3;

/// Points to sum over along an extent of a light that looks 1 wide (extent / distance), if nothing is steep.
const float leastPointsPerDistance = 10.0f;

/// The grid of a profile: angles and values are in the buffer `Profile`, verticals, horizontals, candela.
SHARED_STRUCT ProfileConstants {
    vec3 towardsC0;  // in the light's space
    int type;        // noProfile, ...
    vec3 towardsZenith;
    float firstPlane_rad;  // type C
    int verticals;
    int horizontals;
    float angleScale;  // UsdLux's
    float factor;
    bool32 isMirrored;        // types A and B: -H as H
    bool32 isLuminaire;       // of candela by share of area; else a factor of the luminance
    float pointsPerDistance;  // leastPointsPerDistance, or more where candela change steeply
};

SHARED_STRUCT LightingConstants {
    mat4 lightFromClip;
    mat4 lightFromWorld;  // rotates normals
    vec3 emission;        // nits, candela or lux
    float halfAngle_rad;  // distant lights
    vec2 halfSize_m;      // rects; tubes: half the length, twice
    vec2 coneCosines;     // of a spot's inner and outer half angle; -2 where there is no cone
    float radius_m;       // disks, spheres, tubes
    int shape;            // shapeRect, ...
    bool32 isTwoSided;
    bool32 isPoint;  // of size zero: emission in candela or lux
    bool32 isTextured;
    bool32 isVisibilityColored;
    ivec2 size_px;
    float planeTolerance;  // up to where a point lies in the plane of a flat light (penumbra/light_plane.h)
    ProfileConstants profile;
};

#ifdef __cplusplus
static_assert(sizeof(ProfileConstants) == 64);
static_assert(sizeof(LightingConstants) == 272);
}  // namespace penumbra::studio
#endif
#endif
