// SPDX-License-Identifier: Apache-2.0
// What the G-buffer pass knows of an instance; one struct for C++ and GLSL (std140).
#ifndef PENUMBRA_GBUFFER_IO_H
#define PENUMBRA_GBUFFER_IO_H

#ifdef __cplusplus
#include <glm/glm.hpp>
namespace penumbra::studio {
using glm::ivec4;
using glm::mat4;
using glm::vec4;
#endif

struct InstanceConstants {
    mat4 clipFromMesh;
    mat4 viewFromMesh;
    mat4 worldFromView;       // rotates normals
    mat4 viewFromMeshNormal;  // rotates and stretches normals; not unit
    vec4 baseColor;
    vec4 emission;  // rgb: nits; a: 1 where a texture multiplies them
    vec4 alpha;     // x: cutoff, or -1 where there is no mask; y: 1 where vertices have colours
    ivec4 flags;    // x: has a texture; y: receives; z: unlit; w: orthographic view
};

#ifdef __cplusplus
static_assert(sizeof(InstanceConstants) == 320);
}  // namespace penumbra::studio
#endif
#endif
