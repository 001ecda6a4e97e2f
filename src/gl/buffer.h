// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "src/gl/gl.h"

namespace penumbra::gl {

inline void deleteBuffer(GLuint name) {
    glDeleteBuffers(1, &name);
}

/// A buffer of fixed size that the CPU may write.
class Buffer {
  public:
    Buffer() = default;
    /// Uninitialised. A size of zero is rounded up, since GL has no empty buffers.
    Buffer(std::size_t size_bytes, std::string_view label);
    /// Holds a copy of `bytes`.
    Buffer(std::span<const std::byte> bytes, std::string_view label);

    void write(std::span<const std::byte> bytes, std::size_t offset_bytes = 0);
    /// Waits for the device. Not for use in a frame.
    void read(std::span<std::byte> bytes, std::size_t offset_bytes = 0) const;

    GLuint name() const { return handle_.name(); }
    std::size_t size_bytes() const { return size_bytes_; }

  private:
    Handle<deleteBuffer> handle_;
    std::size_t size_bytes_ = 0;
};

/// One struct that a shader reads (std140 or std430, see the shared *_io.h headers), rewritten for each pass.
template <typename T>
class ConstantBuffer {
  public:
    explicit ConstantBuffer(std::string_view label) : buffer_(sizeof(T), label) {}
    void write(const T& value) { buffer_.write(std::as_bytes(std::span(&value, 1))); }
    void bindUniform(GLuint binding) const { glBindBufferBase(GL_UNIFORM_BUFFER, binding, buffer_.name()); }

  private:
    Buffer buffer_;
};

/// An array that a shader reads, rewritten for each pass; grows to the largest size seen and stays there.
template <typename T>
class StorageArray {
  public:
    explicit StorageArray(std::string_view label) : label_(label) {}
    void write(std::span<const T> values) {
        if (values.size_bytes() > buffer_.size_bytes() || buffer_.name() == 0) {
            buffer_ = Buffer(values.size_bytes(), label_);
        }
        if (!values.empty()) buffer_.write(std::as_bytes(values));
    }
    void bind(GLuint binding) const { glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer_.name()); }

  private:
    std::string_view label_;
    Buffer buffer_;
};

}  // namespace penumbra::gl
