// SPDX-License-Identifier: Apache-2.0
// The receivers' view as shaders see it; one struct for C++ and GLSL (std140).
#ifndef PENUMBRA_VIEW_IO_H
#define PENUMBRA_VIEW_IO_H

#include "src/gl/shared_types.h"

#ifdef __cplusplus
namespace penumbra {
#endif

SHARED_STRUCT ViewConstants {
    mat4 lightFromPicture;  // from normalised x and y, and nearness
    mat4 lightFromWorld;    // rotates normals
    float nearnessScale;    // times the depth, plus
    float nearnessOffset;   // this: nearness
    float backgroundDepth;
    bool32 hasNormals;
    ivec2 size_px;
    bool32 hasReceiverMask;
    bool32 isOfPoints;  // green, blue and alpha of what is stored as depth: the position in world space
};

#ifdef __cplusplus
static_assert(sizeof(ViewConstants) == 160);
}  // namespace penumbra
#endif
#endif
