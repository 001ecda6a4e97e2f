// SPDX-License-Identifier: Apache-2.0
// What the canvas's shaders need to know; structs for C++ and GLSL (std140).
#ifndef PENUMBRA_CANVAS_IO_H
#define PENUMBRA_CANVAS_IO_H

#include "src/gl/shared_types.h"
#include "studio/frame/light_shapes_io.h"

#ifdef __cplusplus
namespace penumbra::studio::viewer {
#endif

// The values of Shown in canvas.h.
const int shownPicture = 0;
const int shownDifference = 1;
const int shownError = 2;
const int shownVisibility = 3;
const int shownIlluminance = 4;

SHARED_STRUCT ComposeConstants {
    ivec2 size_px;
    int shown;
    bool32 hasIsolines;
    float rangeMin;
    float rangeMax;
    bool32 isLogarithmic;
    int firstColumnOfB;  // pixels from here on show side B
};

// What the image of isolines holds where there is none.
const float noIsoline = 0.0;

SHARED_STRUCT InspectConstants {
    ivec2 size_px;
    int layer;
    bool32 isGrey;
    float black;
    float white;
    bool32 isStretched;  // over what is in the texture
};

SHARED_STRUCT LightViewConstants {
    mat4 lightFromClip;
    vec3 eyeLight;
    int shape;
    vec3 eyeWorldForward;
    float radius_m;
    vec2 halfSize_m;      // of a rect; of a tube half its length, twice
    float halfAngle_rad;  // of a distant light
};

#ifdef __cplusplus
}  // namespace penumbra::studio::viewer
#endif
#endif
