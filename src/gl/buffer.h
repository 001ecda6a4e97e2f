// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "src/gl/gl.h"
#include "src/gl/write_order.h"

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

    /// Makes room for at least `size_bytes`; what was in it is lost where that takes another buffer. Grows to
    /// the largest size asked for and stays there.
    void reserve(std::size_t size_bytes, std::string_view label);

    void write(std::span<const std::byte> bytes, std::size_t offset_bytes = 0);
    /// Every byte of the part becomes 0; a size of 0 is all that follows. Both are multiples of four.
    void clear(std::size_t offset_bytes = 0, std::size_t size_bytes = 0);
    void copyTo(Buffer& target, std::size_t size_bytes) const;
    /// Waits for the device. Not for use in a frame.
    void read(std::span<std::byte> bytes, std::size_t offset_bytes = 0) const;

    GLuint name() const { return handle_.name(); }
    std::size_t size_bytes() const { return size_bytes_; }
    /// Kept by passes.
    WriteRecord& record() const { return record_; }

  private:
    Handle<deleteBuffer> handle_;
    mutable WriteRecord record_;
    std::size_t size_bytes_ = 0;
};

/// One struct that a shader reads (std140 or std430, see the shared *_io.h headers), rewritten for each pass.
template <typename T>
class ConstantBuffer {
  public:
    explicit ConstantBuffer(std::string_view label) : buffer_(sizeof(T), label) {}
    void write(const T& value) { buffer_.write(std::as_bytes(std::span(&value, 1))); }
    const Buffer& buffer() const { return buffer_; }

  private:
    Buffer buffer_;
};

/// An array that a shader reads, rewritten for each pass; grows to the largest size seen and stays there.
template <typename T>
class StorageArray {
  public:
    explicit StorageArray(std::string_view label) : label_(label) {}
    void write(std::span<const T> values) {
        buffer_.reserve(values.size_bytes(), label_);
        if (!values.empty()) buffer_.write(std::as_bytes(values));
    }
    const Buffer& buffer() const { return buffer_; }

  private:
    std::string_view label_;
    Buffer buffer_;
};

}  // namespace penumbra::gl
