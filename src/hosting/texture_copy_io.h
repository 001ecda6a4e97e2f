// SPDX-License-Identifier: Apache-2.0
// What texture_copy.comp.glsl needs to know; one struct for C++ and GLSL (std140).
#ifndef PENUMBRA_TEXTURE_COPY_IO_H
#define PENUMBRA_TEXTURE_COPY_IO_H

#include "src/gl/shared_types.h"

#ifdef __cplusplus
namespace penumbra {
#endif

SHARED_STRUCT TextureCopyConstants {
    ivec2 sourceCorner_px;
    ivec2 targetCorner_px;
    ivec2 size_px;
    int lookedAt;   // which sample; level 0 of a texture that has one only
    bool32 isGray;  // red is all colours of what is read
};

#ifdef __cplusplus
}  // namespace penumbra
#endif
#endif
