// SPDX-License-Identifier: Apache-2.0
// What the G-buffer pass knows of an instance; one struct for C++ and GLSL (std140).
#ifndef PENUMBRA_GBUFFER_IO_H
#define PENUMBRA_GBUFFER_IO_H

#include "src/gl/shared_types.h"

#ifdef __cplusplus
namespace penumbra::studio {
#endif

SHARED_STRUCT InstanceConstants {
    mat4 clipFromMesh;
    mat4 viewFromMesh;
    mat4 worldFromView;       // rotates normals
    mat4 viewFromMeshNormal;  // rotates and stretches normals; not unit
    vec4 baseColor;
    vec3 emission_nits;
    float alphaCutoff;  // -1 where there is no mask
    bool32 hasBaseColorTexture;
    bool32 hasEmissionTexture;  // which multiplies
    bool32 hasVertexColors;
    bool32 receives;
    bool32 isUnlit;
    bool32 isOrthographic;  // the view
};

#ifdef __cplusplus
static_assert(sizeof(InstanceConstants) == 320);
}  // namespace penumbra::studio
#endif
#endif
