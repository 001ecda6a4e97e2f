// SPDX-License-Identifier: Apache-2.0
// A caster as the depth pass sees it; one struct for C++ and GLSL (std430).
#ifndef PENUMBRA_DEPTH_MAP_IO_H
#define PENUMBRA_DEPTH_MAP_IO_H

#include "src/gl/shared_types.h"

#ifdef __cplusplus
namespace penumbra {
#endif

SHARED_STRUCT CasterConstants {
    mat4 lightFromMesh;
    float alphaFactor;  // of casters with holes
    float alphaCutoff;
    float unused0, unused1;
};

#ifdef __cplusplus
static_assert(sizeof(CasterConstants) == 80);
}  // namespace penumbra
#endif
#endif
