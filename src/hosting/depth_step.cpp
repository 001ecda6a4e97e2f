// SPDX-License-Identifier: Apache-2.0
#include "src/hosting/depth_step.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

double fixedDepthStep(GLuint texture) {
    // Depths of 32 fixed bits are made of floats: llvmpipe's come in steps of 2^-24.
    constexpr GLint mostBits = 24;
    GLint type = GL_NONE, bits = 0;
    glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_DEPTH_TYPE, &type);
    glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_DEPTH_SIZE, &bits);
    return type == GL_UNSIGNED_NORMALIZED ? std::exp2(-std::min(bits, mostBits)) : 0;
}

}  // namespace penumbra
