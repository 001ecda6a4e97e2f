// SPDX-License-Identifier: Apache-2.0
#include "src/gl/texel_buffer.h"

#include <algorithm>
#include <string>

#include "penumbra/device.h"

namespace penumbra::gl {
namespace {

constexpr std::size_t texel_bytes = sizeof(glm::uvec4);
/// An odd number, this and above, is no power of two: llvmpipe compiles programs for such by themselves.
constexpr std::size_t leastTexels = 3;

}  // namespace

bool TexelBuffer::reserve(std::size_t texels) {
    if (view_.name() != 0 && texels * texel_bytes <= buffer_.size_bytes()) return false;
    GLint64 limit = 0;
    glGetInteger64v(GL_MAX_TEXTURE_BUFFER_SIZE, &limit);
    if (GLint64(texels) > limit) {
        throw Error(Error::Kind::badArgument,
                    std::string(label_) + ": the casters have more triangles than fit into a " +
                        "buffer texture of this device (" + std::to_string(limit) + " texels)");
    }
    view_ = {};
    buffer_.reserve(std::max(texels | 1, leastTexels) * texel_bytes, label_);
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &name);
    view_ = Handle<deleteTexture>(name);
    glTextureBuffer(name, GL_RGBA32UI, buffer_.name());
    return true;
}

void TexelBuffer::write(std::span<const glm::uvec4> texels, std::size_t first) {
    if (!texels.empty()) buffer_.write(std::as_bytes(texels), first * texel_bytes);
}

}  // namespace penumbra::gl
