// SPDX-License-Identifier: Apache-2.0
// How gather_vertices.comp.glsl reads a host's buffer; one struct for C++ and GLSL (std140).
#ifndef PENUMBRA_GATHER_VERTICES_IO_H
#define PENUMBRA_GATHER_VERTICES_IO_H

#include "src/gl/shared_types.h"

#ifdef __cplusplus
namespace penumbra {
#endif

SHARED_STRUCT GatherConstants {
    uint first;  // of this dispatch
    uint count;
    uint offset;     // of the first: words, or halves where wordsEach is 0
    uint stride;     // in words
    uint wordsEach;  // 0: halves of a word, which become words
};

#ifdef __cplusplus
}  // namespace penumbra
#endif
#endif
