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
    const std::size_t allocated_bytes = std::max<std::size_t>(size_bytes, 16);
    forgetErrors();
    glNamedBufferStorage(name(), GLsizeiptr(allocated_bytes), nullptr, GL_DYNAMIC_STORAGE_BIT);
    checkAllocated(text);
    handle_.enter(allocated_bytes);
    label(GL_BUFFER, name(), text);
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
