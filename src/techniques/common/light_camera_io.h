// SPDX-License-Identifier: Apache-2.0
// A light camera as shaders see it; one struct for C++ and GLSL (std430). See light_camera.h.
#ifndef PENUMBRA_LIGHT_CAMERA_IO_H
#define PENUMBRA_LIGHT_CAMERA_IO_H

#ifdef __cplusplus
#include <glm/glm.hpp>
namespace penumbra {
using glm::mat4;
using glm::vec4;
#endif

struct LightCameraConstants {
    mat4 clipFromLight;
    mat4 faceFromLight;
    vec4 window;  // xy: min; zw: 1 / (max - min)
    vec4 depth;   // x: near_m; y: far_m; z: 1 if orthographic; w: size of a texel, in tangents or metres
};

#ifdef __cplusplus
static_assert(sizeof(LightCameraConstants) == 160);
}  // namespace penumbra
#endif
#endif
