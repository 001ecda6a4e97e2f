// SPDX-License-Identifier: Apache-2.0
// A light camera as shaders see it; structs for C++ and GLSL (std140, std430). See light_camera.h.
#ifndef PENUMBRA_LIGHT_CAMERA_IO_H
#define PENUMBRA_LIGHT_CAMERA_IO_H

#include "src/gl/shared_types.h"

#ifdef __cplusplus
namespace penumbra {
#endif

// What a map shows: places in tangents (x/z, y/z), or metres where the camera is orthographic.
SHARED_STRUCT MapWindow {
    vec2 min;
    vec2 perExtent;  // 1 / (max - min)
};

// How a map stores depth along the camera's axis.
SHARED_STRUCT MapDepth {
    float near_m;
    float far_m;
    bool32 isOrthographic;
    float texelSize;  // of the window: tangents, or metres
};

SHARED_STRUCT LightCameraConstants {
    mat4 clipFromLight;
    mat4 faceFromLight;
    MapWindow window;
    MapDepth depth;
};

#ifdef __cplusplus
static_assert(sizeof(LightCameraConstants) == 160);
}  // namespace penumbra
#endif
#endif
