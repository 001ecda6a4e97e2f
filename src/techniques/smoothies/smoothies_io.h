// SPDX-License-Identifier: Apache-2.0
// What a light camera needs to know for drawing and reading smoothies; one struct for C++ and GLSL (std140).
#ifndef PENUMBRA_SMOOTHIES_IO_H
#define PENUMBRA_SMOOTHIES_IO_H

#include "src/techniques/common/light_camera_io.h"
#ifdef __cplusplus
namespace penumbra {
using glm::ivec4;
#endif

const int maxSmoothieCameras = 6;  // the faces of a cube
const int layersPerCamera = 4;     // of edge numbers: the outer half, and three of the inner half
const int smoothieTexel_px = 2;    // of the depth map, along each axis
const int tileSize_px = 8;         // of the picture, for the pixels that smoothies reach
const int tilesPerRow = 1024;      // of the list of those tiles, as it is dispatched

// The profile of a textured light (light_profile.glsl), its first column repeated as its last.
const int profileDirections = 64;
const int profileOffsets = 64;

struct SmoothieConstants {
    LightCameraConstants camera;
    vec4 halfX;     // xyz: the light's half axis along its width or radius, in face space, metres
    vec4 halfY;     // xyz: the same along its height
    vec4 widths;    // x: radius (sphere, m) or tangent of half the angle (distant); y: fixed width t, 0 for
                    // none; z: smallest width; w: largest. All but x in window units (tangents or metres)
    vec4 nearness;  // x: of the farthest receiver; y: of the nearest point that is drawn; z: where an
                    // orthographic camera measures the paper's b and r from
    ivec4 settings;  // x: shape; y: falloff; z: 1 if alpha is remapped; w: 1 with the inner half
    vec4 unused;     // so that a block may begin with any of them
};

#ifdef __cplusplus
static_assert(sizeof(SmoothieConstants) == 256);
}  // namespace penumbra
#endif
#endif
