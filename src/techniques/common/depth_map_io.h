// SPDX-License-Identifier: Apache-2.0
// A caster as the depth pass sees it; one struct for C++ and GLSL (std430).
#ifndef PENUMBRA_DEPTH_MAP_IO_H
#define PENUMBRA_DEPTH_MAP_IO_H

#ifdef __cplusplus
#include <glm/glm.hpp>
namespace penumbra {
using glm::mat4;
using glm::vec4;
#endif

struct CasterConstants {
    mat4 lightFromMesh;
    vec4 alpha;  // x: factor; y: cutoff
};

#ifdef __cplusplus
static_assert(sizeof(CasterConstants) == 80);
}  // namespace penumbra
#endif
#endif
