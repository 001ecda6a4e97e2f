// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/gl/gl.h"

namespace penumbra {

/// The least difference between depths of fixed bits that a driver writes into the texture, as a share of
/// their range; 0 where they are floats, or it holds none.
double fixedDepthStep(GLuint texture);

}  // namespace penumbra
