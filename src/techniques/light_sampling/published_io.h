// SPDX-License-Identifier: Apache-2.0
// A cell of the published tree, shared between C++ and GLSL (std140).
#ifndef PENUMBRA_PUBLISHED_IO_H
#define PENUMBRA_PUBLISHED_IO_H

#include "src/gl/shared_types.h"

#ifdef __cplusplus
namespace penumbra::light_sampling {
#endif

SHARED_STRUCT PublishedConstants {
    ivec4 slots[2];  // of the samples at the corners
    ivec2 target_px;
    int corners;       // 4 of a quad, 8 of an octant
    float brightness;  // of what fails, in the picture of it
};

#ifdef __cplusplus
}  // namespace penumbra::light_sampling
#endif
#endif
