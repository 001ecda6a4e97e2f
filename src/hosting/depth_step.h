// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/gl/gl.h"

namespace penumbra {

/// The least difference between depths of fixed bits that shaders can tell, as a share of their range; 0 where the
/// texture holds floats, or no depths.
double fixedDepthStep(GLuint texture);

}  // namespace penumbra
