// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <initializer_list>
#include <string_view>

#include "src/gl/gl.h"

namespace penumbra::gl {

class Texture;
struct WriteRecord;

inline void deleteFramebuffer(GLuint name) {
    glDeleteFramebuffers(1, &name);
}

/// Textures to draw into, which stay where they are while it lives. All layers of array textures are
/// attached, so that a shader chooses with gl_Layer.
class Framebuffer {
  public:
    Framebuffer() = default;
    /// Becomes a framebuffer of these, unless it is one: of the very textures, since a name may have gone to
    /// another. Either may be empty (null). Throws Error::Kind::outOfMemory if the driver cannot draw to this
    /// combination.
    void fit(std::initializer_list<const Texture*> colors, const Texture* depth, std::string_view label);

    /// Attaches one layer of the depth texture alone, for drivers that cannot choose a layer in the vertex
    /// shader.
    void attachDepthLayer(const Texture& depth, int layer);

    /// Whatever shaders have written to the textures is there before drawing goes on.
    void makeVisible() const;

    GLuint name() const { return handle_.name(); }

  private:
    static constexpr std::size_t mostTextures = 6;

    Handle<deleteFramebuffer> handle_;
    std::array<WriteRecord*, mostTextures> records_{};  ///< of its textures
    std::array<std::uint64_t, mostTextures> identities_{};
};

}  // namespace penumbra::gl
