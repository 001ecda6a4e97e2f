// SPDX-License-Identifier: Apache-2.0
// What caster_picture.*.glsl need to know; one struct for C++ and GLSL (std140).
#ifndef PENUMBRA_CASTER_PICTURE_IO_H
#define PENUMBRA_CASTER_PICTURE_IO_H

#include "src/gl/shared_types.h"

#ifdef __cplusplus
namespace penumbra {
#endif

SHARED_STRUCT CasterPictureConstants {
    mat4 clipFromMesh;
    float caster;  // which
    float alphaFactor;
    float alphaCutoff;
    bool32 hasMask;
};

#ifdef __cplusplus
}  // namespace penumbra
#endif
#endif
