// SPDX-License-Identifier: Apache-2.0
// The receivers' view as shaders see it; one struct for C++ and GLSL (std140).
#ifndef PENUMBRA_VIEW_IO_H
#define PENUMBRA_VIEW_IO_H

#ifdef __cplusplus
#include <glm/glm.hpp>
namespace penumbra {
using glm::ivec4;
using glm::mat4;
using glm::vec4;
#endif

struct ViewConstants {
    mat4 lightFromPicture;   // from normalised x and y, and nearness
    mat4 lightFromWorld;     // rotates normals
    vec4 nearnessFromDepth;  // x: scale, y: offset, z: the background's depth
    ivec4 size_px;           // xy: size; z: 1 if there are normals; w: 1 if there is a receiver mask
};

#ifdef __cplusplus
static_assert(sizeof(ViewConstants) == 160);
}  // namespace penumbra
#endif
#endif
