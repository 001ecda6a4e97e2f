// SPDX-License-Identifier: Apache-2.0
#include "src/gl/texture_target.h"

namespace penumbra::gl {

// Not by asking for GL_TEXTURE_TARGET: in compatibility contexts Mesa knows no such parameter.
GLenum targetOf(GLuint texture) {
    if (!glIsTexture(texture)) return GL_NONE;
    glActiveTexture(GL_TEXTURE0);
    glBindTextureUnit(0, 0);  // all targets
    glBindTextureUnit(0, texture);
    GLenum found = GL_NONE;
    for (const TextureTarget& target : textureTargets) {
        GLint bound = 0;
        glGetIntegerv(target.binding, &bound);
        if (GLuint(bound) == texture) found = target.target;
    }
    glBindTextureUnit(0, 0);
    return found;
}

}  // namespace penumbra::gl
