// SPDX-License-Identifier: Apache-2.0
// What smooth_surface.comp.glsl needs to know; one struct for C++ and GLSL (std140).
#ifndef PENUMBRA_SMOOTH_SURFACE_IO_H
#define PENUMBRA_SMOOTH_SURFACE_IO_H

#include "src/gl/shared_types.h"

#ifdef __cplusplus
namespace penumbra {
#endif

SHARED_STRUCT SmoothSurfaceConstants {
    mat4 viewFromDepth;  // from normalised x and y, and depth; w not divided out
    mat4 depthFromView;
    mat4 viewFromWorld;  // rotates normals
    ivec2 size_px;
    float background;  // depth
    bool32 isOrthographic;
};

#ifdef __cplusplus
}  // namespace penumbra
#endif
#endif
