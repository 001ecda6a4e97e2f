// SPDX-License-Identifier: Apache-2.0
// What the PCSS shader needs to know of the light; one struct for C++ and GLSL (std140).
#ifndef PENUMBRA_PCSS_IO_H
#define PENUMBRA_PCSS_IO_H

#ifdef __cplusplus
#include <glm/glm.hpp>
namespace penumbra {
using glm::ivec4;
using glm::vec4;
#endif

struct PcssConstants {
    vec4 extent;    // xy: half width and height, metres (distant: tangents); z: 1 - cos of a distant light's
                    // half angle
    ivec4 light;    // x: LightShape; y: 1 if one-sided; z: 1 if textured
    ivec4 samples;  // x: of the search; y: of the filter; z: 1 if rotated from pixel to pixel; w: 1 for a
                    // harmonic mean
    ivec4 maps;     // x: how many; y: width of a tile of theirs (nearest_tiles.glsl), in texels
};

#ifdef __cplusplus
static_assert(sizeof(PcssConstants) == 64);
}  // namespace penumbra
#endif
#endif
