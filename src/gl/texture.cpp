// SPDX-License-Identifier: Apache-2.0
#include "src/gl/texture.h"

namespace penumbra::gl {
namespace {

GLuint createTexture(GLenum target) {
    GLuint name = 0;
    glCreateTextures(target, 1, &name);
    return name;
}

}  // namespace

Texture::Texture(const TextureSpec& spec)
    : handle_(createTexture(spec.layers > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D)), spec_(spec) {
    if (spec.layers > 0) {
        glTextureStorage3D(name(), spec.levels, spec.format, spec.width_px, spec.height_px, spec.layers);
    } else {
        glTextureStorage2D(name(), spec.levels, spec.format, spec.width_px, spec.height_px);
    }
    label(GL_TEXTURE, name(), spec.label);
    checkAllocated(spec.label);
    spec_.label = {};
    glTextureParameteri(name(), GL_TEXTURE_MIN_FILTER, GLint(spec.filter));
    glTextureParameteri(name(), GL_TEXTURE_MAG_FILTER, GLint(spec.filter));
    glTextureParameteri(name(), GL_TEXTURE_WRAP_S, GLint(spec.wrap));
    glTextureParameteri(name(), GL_TEXTURE_WRAP_T, GLint(spec.wrap));
}

void Texture::bindImage(GLuint unit, GLenum access) const {
    glBindImageTexture(unit, name(), 0, GL_TRUE, 0, access, spec_.format);
}

}  // namespace penumbra::gl
