// SPDX-License-Identifier: Apache-2.0
#include "src/hosting/stored_depth.h"

#include <cmath>

namespace penumbra {

double fixedDepthStep(GLuint texture) {
    GLint type = GL_NONE, bits = 0;
    glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_DEPTH_TYPE, &type);
    glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_DEPTH_SIZE, &bits);
    if (bits > bitsReadWhole) bits = bitsReadWhole - 1;
    return type == GL_UNSIGNED_NORMALIZED ? std::exp2(-bits) : 0;
}

glm::dmat4 clipFromStored(const DepthConvention& depth) {
    glm::dmat4 result(1);
    if (depth.range == DepthConvention::Range::minusOneToOne) {
        result[2][2] = 2;
        result[3][2] = -1;
    }
    return result;
}

}  // namespace penumbra
