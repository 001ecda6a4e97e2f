// SPDX-License-Identifier: Apache-2.0
// The light and the curve of attenuation as shaders see them; one struct for C++ and GLSL (std140).
#ifndef PENUMBRA_SHADOW_WIDTH_IO_H
#define PENUMBRA_SHADOW_WIDTH_IO_H

#include "src/techniques/common/light_camera_io.h"

#ifdef __cplusplus
namespace penumbra {
using glm::ivec4;
#endif

// Directions are in the receivers' space: the map's where there is one map, else the light's. Half axes are
// (width / 2, 0, 0) and (0, height / 2, 0) of a rect in the light's space, (radius, 0, 0) and (0, radius, 0)
// of a disk, 0 of others.
struct ShadowWidthConstants {
    vec4 halfAxisX;    // w: a sphere's radius, or tan(angle / 2) of a distant light
    vec4 halfAxisY;    // w: the light's mean half extent
    vec4 attenuation;  // x: c_scale, or -1: physical; y: c_bias; z: texels to a unit of width
    vec4 emission;     // where the light's -Z points
    vec4 extent;       // x: the light's largest half extent
    ivec4 light;       // x: LightShape; y: number of maps; z: 1 if one-sided; w: how many kinds of edges
                       // (edge_cells.glsl)
    ivec4 cells;       // x: a cell's width in texels; y: cells across a map
    LightCameraConstants firstCamera;  // of the depth maps; with one map, in that map's space
};

#ifdef __cplusplus
static_assert(sizeof(ShadowWidthConstants) == 272);
}  // namespace penumbra
#endif
#endif
