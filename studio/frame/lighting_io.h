// SPDX-License-Identifier: Apache-2.0
// A light as the lighting pass sees it; one struct for C++ and GLSL (std140).
#ifndef PENUMBRA_LIGHTING_IO_H
#define PENUMBRA_LIGHTING_IO_H

#ifdef __cplusplus
#include <glm/glm.hpp>
namespace penumbra::studio {
using glm::ivec4;
using glm::mat4;
using glm::vec4;
#endif

struct LightingConstants {
    mat4 lightFromClip;
    mat4 lightFromWorld;  // rotates normals
    vec4 emission;        // rgb: nits, candela or lux; a: unused
    vec4 size;  // xy: half extents of a rect; z: radius of a disk or sphere; w: half angle of a distant light
    vec4 cone;  // x: cosine of the inner, y: of the outer half angle of a spot; -2 where there is none
    ivec4 kind;    // x: LightShape; y: two-sided; z: emission is of a point (candela, lux); w: textured
    ivec4 target;  // xy: size in pixels; z: colored visibility
};

#ifdef __cplusplus
static_assert(sizeof(LightingConstants) == 208);
}  // namespace penumbra::studio
#endif
#endif
