// SPDX-License-Identifier: Apache-2.0
// The light and the curve of attenuation as shaders see them; one struct for C++ and GLSL (std140).
#ifndef PENUMBRA_SHADOW_WIDTH_IO_H
#define PENUMBRA_SHADOW_WIDTH_IO_H

#ifdef __cplusplus
#include <glm/glm.hpp>
namespace penumbra {
using glm::ivec4;
using glm::vec4;
#endif

struct ShadowWidthConstants {
    vec4 halfAxisX;  // rect: (width / 2, 0, 0); disk: (radius, 0, 0); else 0. w: sphere: radius; distant:
                     // tan(angle / 2)
    vec4
        halfAxisY;  // rect: (0, height / 2, 0); disk: (0, radius, 0); else 0. w: the light's mean half extent
    vec4 attenuation;  // x: c_scale, or -1 for the physical one; y: c_bias; z: texels of width to a unit of
                       // the map
    ivec4
        light;  // x: LightShape; y: number of maps; z: 1 if one-sided; w: 1 if there are maps of inner edges
};

#ifdef __cplusplus
static_assert(sizeof(ShadowWidthConstants) == 64);
}  // namespace penumbra
#endif
#endif
