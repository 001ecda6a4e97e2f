// SPDX-License-Identifier: Apache-2.0
// What the depth pass sees of casters and the light; structs for C++ and GLSL (std430, std140).
#ifndef PENUMBRA_DEPTH_MAP_IO_H
#define PENUMBRA_DEPTH_MAP_IO_H

#include "src/techniques/common/light_io.h"

#ifdef __cplusplus
namespace penumbra {
#endif

SHARED_STRUCT CasterConstants {
    mat4 lightFromMesh;
    float alphaFactor;  // of casters with holes
    float alphaCutoff;
    float unused0, unused1;
};

SHARED_STRUCT DepthMapConstants {
    LightConstants light;
};

#ifdef __cplusplus
static_assert(sizeof(CasterConstants) == 80);
}  // namespace penumbra
#endif
#endif
