// SPDX-License-Identifier: Apache-2.0
// What is shown of two sides; one struct for C++ and GLSL (std140).
#ifndef PENUMBRA_COMPOSE_IO_H
#define PENUMBRA_COMPOSE_IO_H

#ifdef __cplusplus
#include <glm/glm.hpp>
namespace penumbra::studio::viewer {
using glm::ivec4;
using glm::vec4;
#endif

struct ComposeConstants {
    ivec4 size;  // xy: pixels; z: what is shown (Shown); w: isolines
    vec4 range;  // x: value of the map's first, y: of its last colour; z: logarithmic; w: first column of
                 // side B
};

#ifdef __cplusplus
static_assert(sizeof(ComposeConstants) == 32);
}  // namespace penumbra::studio::viewer
#endif
#endif
