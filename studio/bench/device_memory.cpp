// SPDX-License-Identifier: Apache-2.0
#include "studio/bench/device_memory.h"

#include <algorithm>

#include "src/gl/gl.h"

namespace penumbra::studio {
namespace {

/// So many names without an object end the census.
constexpr GLuint gap = 4096;

GLint levelParameter(GLuint texture, GLint level, GLenum name) {
    GLint value = 0;
    glGetTextureLevelParameteriv(texture, level, name, &value);
    return value;
}

std::size_t textureSize_bytes(GLuint texture) {
    // A buffer texture is a view of a buffer, which is counted by itself.
    if (levelParameter(texture, 0, GL_TEXTURE_BUFFER_DATA_STORE_BINDING) != 0) return 0;
    GLint levels = 0;
    glGetTextureParameteriv(texture, GL_TEXTURE_IMMUTABLE_LEVELS, &levels);
    std::size_t size_bytes = 0;
    for (GLint level = 0; level < std::max(levels, 1); ++level) {
        std::size_t bits = 0;
        for (const GLenum channel :
             {GL_TEXTURE_RED_SIZE, GL_TEXTURE_GREEN_SIZE, GL_TEXTURE_BLUE_SIZE, GL_TEXTURE_ALPHA_SIZE,
              GL_TEXTURE_DEPTH_SIZE, GL_TEXTURE_STENCIL_SIZE, GL_TEXTURE_SHARED_SIZE}) {
            bits += std::size_t(levelParameter(texture, level, channel));
        }
        size_bytes += std::size_t(levelParameter(texture, level, GL_TEXTURE_WIDTH)) *
                      std::size_t(levelParameter(texture, level, GL_TEXTURE_HEIGHT)) *
                      std::size_t(levelParameter(texture, level, GL_TEXTURE_DEPTH)) * (bits / 8);
    }
    return size_bytes;
}

std::size_t bufferSize_bytes(GLuint buffer) {
    GLint64 size_bytes = 0;
    glGetNamedBufferParameteri64v(buffer, GL_BUFFER_SIZE, &size_bytes);
    return std::size_t(size_bytes);
}

template <typename IsObject, typename Size>
std::size_t census(IsObject isObject, Size size) {
    std::size_t size_bytes = 0;
    for (GLuint name = 1, last = 0; name <= last + gap; ++name) {
        if (isObject(name) == GL_FALSE) continue;
        size_bytes += size(name);
        last = name;
    }
    return size_bytes;
}

}  // namespace

std::size_t memoryInUse_bytes() {
    return census([](GLuint name) { return glIsTexture(name); }, textureSize_bytes) +
           census([](GLuint name) { return glIsBuffer(name); }, bufferSize_bytes);
}

}  // namespace penumbra::studio
