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

void Buffer::reserve(std::size_t size_bytes, std::string_view text) {
    if (name() != 0 && size_bytes_ >= size_bytes) return;
    *this = {};  // freed first, so that the two need not fit together
    *this = Buffer(size_bytes, text);
}

void Buffer::write(std::span<const std::byte> bytes, std::size_t offset_bytes) {
    record_.makeVisible(GL_BUFFER_UPDATE_BARRIER_BIT);
    glNamedBufferSubData(name(), GLintptr(offset_bytes), GLsizeiptr(bytes.size()), bytes.data());
}

void Buffer::clear(std::size_t offset_bytes, std::size_t size_bytes) {
    record_.makeVisible(GL_BUFFER_UPDATE_BARRIER_BIT);
    const std::size_t size = size_bytes != 0 ? size_bytes : size_bytes_ - offset_bytes;
    glClearNamedBufferSubData(name(), GL_R32UI, GLintptr(offset_bytes), GLsizeiptr(size), GL_RED_INTEGER,
                              GL_UNSIGNED_INT, nullptr);
}

void Buffer::copyTo(Buffer& target, std::size_t size_bytes) const {
    record_.makeVisible(GL_BUFFER_UPDATE_BARRIER_BIT);
    target.record_.makeVisible(GL_BUFFER_UPDATE_BARRIER_BIT);
    glCopyNamedBufferSubData(name(), target.name(), 0, 0, GLsizeiptr(size_bytes));
}

void Buffer::read(std::span<std::byte> bytes, std::size_t offset_bytes) const {
    record_.makeVisible(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(name(), GLintptr(offset_bytes), GLsizeiptr(bytes.size()), bytes.data());
}

}  // namespace penumbra::gl
