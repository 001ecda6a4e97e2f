// SPDX-License-Identifier: Apache-2.0
// What offset_undoing.comp.glsl needs to know; one struct for C++ and GLSL (std140).
#ifndef PENUMBRA_OFFSET_UNDOING_IO_H
#define PENUMBRA_OFFSET_UNDOING_IO_H

#include "src/gl/shared_types.h"

#ifdef __cplusplus
namespace penumbra {
#endif

SHARED_STRUCT OffsetUndoingConstants {
    mat4 worldFromDepth;       // from normalised x and y, and depth; w not divided out
    mat4 depthPlaneFromWorld;  // of planes
    mat4 worldPlaneFromDepth;
    ivec2 size_px;
    float factor;  // glPolygonOffset's
    float units;
    float leastDifference;  // that depths of fixed bits can have; 0: depths are floats
    float background;
    bool32 hasNormals;
    bool32 hasCasters;
};

#ifdef __cplusplus
}  // namespace penumbra
#endif
#endif
