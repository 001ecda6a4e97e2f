// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "src/gl/gl.h"

namespace penumbra::gl {

inline void deleteTexture(GLuint name) {
    glDeleteTextures(1, &name);
}

struct TextureSpec {
    int width_px = 1;
    int height_px = 1;
    int layers = 0;  ///< 0: GL_TEXTURE_2D; from 1: GL_TEXTURE_2D_ARRAY
    int levels = 1;
    GLenum format = GL_RGBA8;
    GLenum filter = GL_NEAREST;
    GLenum wrap = GL_CLAMP_TO_EDGE;
    std::string_view label;
};

/// Immutable storage, created complete.
class Texture {
  public:
    Texture() = default;
    /// Throws Error::Kind::outOfMemory where the device has no room.
    explicit Texture(const TextureSpec& spec);

    void bind(GLuint unit) const { glBindTextureUnit(unit, name()); }
    void bindImage(GLuint unit, GLenum access) const;

    GLuint name() const { return handle_.name(); }
    int width_px() const { return spec_.width_px; }
    int height_px() const { return spec_.height_px; }
    int layers() const { return spec_.layers; }
    GLenum format() const { return spec_.format; }

  private:
    Handle<deleteTexture> handle_;
    TextureSpec spec_;
};

}  // namespace penumbra::gl
