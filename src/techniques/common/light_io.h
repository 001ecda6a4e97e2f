// SPDX-License-Identifier: Apache-2.0
// The light as every shader sees it; one struct for C++ and GLSL (std140, std430).
#ifndef PENUMBRA_LIGHT_IO_H
#define PENUMBRA_LIGHT_IO_H

#include "src/gl/shared_types.h"

#ifdef __cplusplus
namespace penumbra {
#endif

// The values of penumbra::LightShape.
const int shapeRect = 0;
const int shapeDisk = 1;
const int shapeSphere = 2;
const int shapeDistant = 3;
const int shapeCylinder = 4;

SHARED_STRUCT LightConstants {
    vec2 halfSize;  // rect: half its width and height, metres; disk and sphere: the radius, twice; distant:
                    // the tangent of half its angle, twice; cylinder: half its length, and its radius
    int shape;      // shapeRect, ...
    bool32 isOneSided;  // emits along -Z alone
    bool32 hasSize;     // is more than a point or a direction
    bool32 isTextured;
    float planeTolerance;  // as in penumbra/light_plane.h
};

#ifdef __cplusplus
static_assert(sizeof(LightConstants) == 32);
}  // namespace penumbra
#endif
#endif
