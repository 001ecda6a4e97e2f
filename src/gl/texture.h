// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "src/gl/gl.h"
#include "src/gl/write_order.h"

namespace penumbra::gl {

inline void deleteTexture(GLuint name) {
    glDeleteTextures(1, &name);
}

/// Of texels; what passes and hosts of ours use.
enum class Format : GLenum {
    none = GL_NONE,
    r8 = GL_R8,
    r16f = GL_R16F,
    r32f = GL_R32F,
    r32ui = GL_R32UI,
    rg16f = GL_RG16F,
    rg32f = GL_RG32F,
    rgba8 = GL_RGBA8,
    rgba8srgb = GL_SRGB8_ALPHA8,
    rgba16f = GL_RGBA16F,
    rgba32f = GL_RGBA32F,
    rgba32ui = GL_RGBA32UI,
    depth32f = GL_DEPTH_COMPONENT32F,
    depth32fStencil8 = GL_DEPTH32F_STENCIL8,
};

enum class Wrap : GLenum { clamp = GL_CLAMP_TO_EDGE, repeat = GL_REPEAT };
enum class Filter : GLenum { nearest = GL_NEAREST, linear = GL_LINEAR };

/// A texture as passes bind it; also one that is not ours, which they may read.
struct TextureRef {
    GLuint name = 0;
    Format format = Format::none;  ///< bound as an image it must be stated
    int level = 0;
    bool isLayered = true;
    WriteRecord* record = nullptr;  ///< null: no shader of ours writes it
};

struct TextureSpec {
    int width_px = 1;
    int height_px = 1;
    int layers = 0;  ///< 0: GL_TEXTURE_2D; from 1: GL_TEXTURE_2D_ARRAY
    int levels = 1;
    Format format = Format::rgba8;
    Filter filter = Filter::nearest;
    Wrap wrap = Wrap::clamp;
    std::string_view label;
};

/// Immutable storage, created complete.
class Texture {
  public:
    Texture() = default;
    /// Throws Error::Kind::outOfMemory where the device has no room.
    explicit Texture(const TextureSpec& spec);

    /// Becomes a texture as `spec` says, unless it is one: of the same sizes and format, with as many layers
    /// or more. What was in it is then lost. True if it was made anew.
    bool fit(const TextureSpec& spec);

    /// All texels of level 0 become 0.
    void clear();
    /// Level 0, to a texture of the same size and format.
    void copyTo(Texture& target) const;
    /// One layer's texels of level 0, row by row, tightly packed, as `format` stores them.
    void write(std::span<const std::byte> texels, int layer = 0);
    /// The same, the other way. Waits for the device: not for use in a frame.
    void read(std::span<std::byte> texels, int layer = 0) const;

    TextureRef ref(int level = 0) const { return {name(), format(), level, true, &record_}; }
    /// Kept by passes.
    WriteRecord& record() const { return record_; }

    GLuint name() const { return handle_.name(); }
    std::uint64_t identity() const { return handle_.identity(); }
    int width_px() const { return spec_.width_px; }
    int height_px() const { return spec_.height_px; }
    int layers() const { return spec_.layers; }
    Format format() const { return spec_.format; }

  private:
    Handle<deleteTexture> handle_;
    mutable WriteRecord record_;
    TextureSpec spec_;
};

}  // namespace penumbra::gl
