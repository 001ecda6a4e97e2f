// SPDX-License-Identifier: Apache-2.0
#include "src/gl/texture.h"

#include <algorithm>

namespace penumbra::gl {
namespace {

GLuint createTexture(GLenum target) {
    GLuint name = 0;
    glCreateTextures(target, 1, &name);
    return name;
}

std::size_t sizeOf(GLuint texture, const TextureSpec& spec) {
    std::size_t texel_bits = 0;
    for (const GLenum part :
         {GL_TEXTURE_RED_SIZE, GL_TEXTURE_GREEN_SIZE, GL_TEXTURE_BLUE_SIZE, GL_TEXTURE_ALPHA_SIZE,
          GL_TEXTURE_SHARED_SIZE, GL_TEXTURE_DEPTH_SIZE, GL_TEXTURE_STENCIL_SIZE}) {
        GLint bits = 0;
        glGetTextureLevelParameteriv(texture, 0, part, &bits);
        texel_bits += std::size_t(bits);
    }
    std::size_t texels = 0;
    for (int level = 0; level < spec.levels; ++level) {
        texels += std::size_t(std::max(1, spec.width_px >> level)) *
                  std::size_t(std::max(1, spec.height_px >> level)) * std::size_t(std::max(1, spec.layers));
    }
    return texels * texel_bits / 8;
}

}  // namespace

Texture::Texture(const TextureSpec& spec)
    : handle_(createTexture(spec.layers > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D)), spec_(spec) {
    forgetErrors();
    if (spec.layers > 0) {
        glTextureStorage3D(name(), spec.levels, spec.format, spec.width_px, spec.height_px, spec.layers);
    } else {
        glTextureStorage2D(name(), spec.levels, spec.format, spec.width_px, spec.height_px);
    }
    checkAllocated(spec.label);
    handle_.enter(sizeOf(name(), spec));
    label(GL_TEXTURE, name(), spec.label);
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
