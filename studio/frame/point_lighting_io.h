// SPDX-License-Identifier: Apache-2.0
// One struct for C++ and GLSL (std140).
#ifndef PENUMBRA_POINT_LIGHTING_IO_H
#define PENUMBRA_POINT_LIGHTING_IO_H

#include "studio/frame/lighting_io.h"

#ifdef __cplusplus
namespace penumbra::studio {
#endif

SHARED_STRUCT PointLightingConstants {
    LightingConstants light;
    bool32 isShadowed;  // else all is seen, and there is no bound
};

#ifdef __cplusplus
static_assert(sizeof(PointLightingConstants) == 288);
}  // namespace penumbra::studio
#endif
#endif
