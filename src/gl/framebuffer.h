// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <string_view>

#include "src/gl/gl.h"

namespace penumbra::gl {

class Texture;

inline void deleteFramebuffer(GLuint name) {
    glDeleteFramebuffers(1, &name);
}

/// Textures to draw into. All layers of array textures are attached, so that a shader chooses with gl_Layer.
class Framebuffer {
  public:
    Framebuffer() = default;
    /// Either may be empty (null). Throws Error::Kind::outOfMemory if the driver cannot draw to this
    /// combination.
    Framebuffer(std::initializer_list<const Texture*> colors, const Texture* depth, std::string_view label);

    /// Attaches one layer of the depth texture alone, for drivers that cannot choose a layer in the vertex
    /// shader.
    void attachDepthLayer(const Texture& depth, int layer);

    GLuint name() const { return handle_.name(); }

  private:
    Handle<deleteFramebuffer> handle_;
};

}  // namespace penumbra::gl
