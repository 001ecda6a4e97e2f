// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/gl/gl.h"

namespace penumbra {

/// Fixed bits of depth that shaders read whole. Of 32 llvmpipe's read 23: what is less is cut off, towards 0.
inline constexpr int bitsReadWhole = 24;

/// The least difference between depths of fixed bits that shaders can tell, as a share of their range; 0
/// where the texture holds floats, or no depths.
double fixedDepthStep(GLuint texture);

}  // namespace penumbra
