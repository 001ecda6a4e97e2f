// SPDX-License-Identifier: Apache-2.0
// What darkening.frag.glsl needs to know; one struct for C++ and GLSL (std140).
#ifndef PENUMBRA_DARKENING_IO_H
#define PENUMBRA_DARKENING_IO_H

#include "src/gl/shared_types.h"

#ifdef __cplusplus
namespace penumbra {
#endif

SHARED_STRUCT DarkeningConstants {
    ivec2 pictureCorner_px;     // in the framebuffer
    ivec2 visibilityCorner_px;  // in its texture
    float leastLit;
    bool32 isColored;
};

#ifdef __cplusplus
}  // namespace penumbra
#endif
#endif
