// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "penumbra/view.h"
#include "src/device/glm_types.h"
#include "src/gl/gl.h"

namespace penumbra {

/// Fixed bits of depth that shaders read whole. Of 32 llvmpipe's read 23: what is less is cut off, towards 0.
inline constexpr int bitsReadWhole = 24;

/// The least difference between depths of fixed bits that shaders can tell, as a share of their range; 0
/// where the texture holds floats, or no depths.
double fixedDepthStep(GLuint texture);

/// To clip space from normalised x and y and the depth as it is stored, in [0, 1].
glm::dmat4 clipFromStored(const DepthConvention& depth);

}  // namespace penumbra
