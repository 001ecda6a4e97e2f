// SPDX-License-Identifier: Apache-2.0
#include "src/hosting/depth_step.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

double fixedDepthStep(GLuint texture) {
    // Of 32 fixed bits shaders read fewer: llvmpipe's 23.
    constexpr GLint mostBits = 23;
    GLint type = GL_NONE, bits = 0;
    glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_DEPTH_TYPE, &type);
    glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_DEPTH_SIZE, &bits);
    return type == GL_UNSIGNED_NORMALIZED ? std::exp2(-std::min(bits, mostBits)) : 0;
}

}  // namespace penumbra
