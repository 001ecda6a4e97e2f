// SPDX-License-Identifier: Apache-2.0
// What the shaders need to know; structs for C++ and GLSL (std140).
#ifndef PENUMBRA_VARIANCE_IO_H
#define PENUMBRA_VARIANCE_IO_H

#include "src/techniques/common/light_io.h"

#ifdef __cplusplus
namespace penumbra::variance_map {
#endif

SHARED_STRUCT MomentsConstants {
    int radius_px;
    bool32 isAcross;  // the first of two: it reads depths
};

SHARED_STRUCT VarianceConstants {
    LightConstants light;
    int mapCount;
};

#ifdef __cplusplus
}  // namespace penumbra::variance_map
#endif
#endif
