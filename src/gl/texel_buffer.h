// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <string_view>

#include "src/gl/buffer.h"
#include "src/gl/texture.h"

namespace penumbra::gl {

/// A buffer that shaders read with imageLoad (readonly uimageBuffer), four words at a time; floats travel as
/// their bits, among integers. It is an image and no usamplerBuffer because Mesa leaves such a sampler's
/// filters as the program before had them, and compiles anew for each kind it meets.
class TexelBuffer {
  public:
    explicit TexelBuffer(std::string_view label) : label_(label) {}
    /// Makes room for so many; what was there is lost where it has to grow, which the result says. Throws
    /// Error::Kind::badArgument where the device can address no more than fewer.
    bool reserve(std::size_t texels);
    void write(std::span<const glm::uvec4> texels, std::size_t first);
    TextureRef ref() const { return {.name = view_.name(), .format = Format::rgba32ui}; }
    std::size_t size_bytes() const { return buffer_.size_bytes(); }

  private:
    std::string_view label_;
    Buffer buffer_;
    Handle<deleteTexture> view_;
};

}  // namespace penumbra::gl
