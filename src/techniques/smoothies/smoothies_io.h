// SPDX-License-Identifier: Apache-2.0
// What a light camera needs to know for drawing and reading smoothies; one struct for C++ and GLSL (std430).
#ifndef PENUMBRA_SMOOTHIES_IO_H
#define PENUMBRA_SMOOTHIES_IO_H

#ifdef __cplusplus
#include <glm/glm.hpp>
namespace penumbra {
using glm::ivec4;
using glm::vec4;
#endif

struct SmoothieConstants {
    vec4 halfX;      // xyz: the light's half axis along its width or radius, in face space, metres
    vec4 halfY;      // xyz: the same along its height
    vec4 widths;     // x: radius (sphere, m) or tangent of half the angle (distant); y: fixed width t, 0 for
                     // none; z: smallest width; w: largest. All but x in window units (tangents or metres)
    vec4 nearness;   // x: of the farthest receiver; y: of the nearest point that is drawn
    ivec4 settings;  // x: shape; y: falloff; z: 1 if alpha is remapped; w: 1 with the inner half
};

#ifdef __cplusplus
static_assert(sizeof(SmoothieConstants) == 80);
}  // namespace penumbra
#endif
#endif
