// SPDX-License-Identifier: Apache-2.0
#include "src/gl/buffer.h"

#include <algorithm>

namespace penumbra::gl {
namespace {

GLuint createBuffer() {
    GLuint name = 0;
    glCreateBuffers(1, &name);
    return name;
}

}  // namespace

Buffer::Buffer(std::size_t size_bytes, std::string_view text)
    : handle_(createBuffer()), size_bytes_(size_bytes) {
    glNamedBufferStorage(name(), GLsizeiptr(std::max<std::size_t>(size_bytes, 16)), nullptr,
                         GL_DYNAMIC_STORAGE_BIT);
    label(GL_BUFFER, name(), text);
    checkAllocated(text);
}

Buffer::Buffer(std::span<const std::byte> bytes, std::string_view text) : Buffer(bytes.size(), text) {
    if (!bytes.empty()) write(bytes);
}

void Buffer::write(std::span<const std::byte> bytes, std::size_t offset_bytes) {
    glNamedBufferSubData(name(), GLintptr(offset_bytes), GLsizeiptr(bytes.size()), bytes.data());
}

void Buffer::read(std::span<std::byte> bytes, std::size_t offset_bytes) const {
    glGetNamedBufferSubData(name(), GLintptr(offset_bytes), GLsizeiptr(bytes.size()), bytes.data());
}

}  // namespace penumbra::gl
