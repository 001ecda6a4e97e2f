// SPDX-License-Identifier: Apache-2.0
// The only place that includes OpenGL, and the base of the owners in this folder.
#pragma once

#include <epoxy/gl.h>

#include <string_view>
#include <utility>

namespace penumbra::gl {

/// A GL object name that is deleted with its owner. Move-only; 0 is no object.
template <void (*Delete)(GLuint)>
class Handle {
  public:
    Handle() = default;
    explicit Handle(GLuint name) : name_(name) {}
    Handle(Handle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    ~Handle() {
        if (name_ != 0) Delete(name_);
    }
    GLuint name() const { return name_; }

  private:
    GLuint name_ = 0;
};

/// Names an object for debuggers and driver messages: "smoothies/depth".
void label(GLenum kind, GLuint name, std::string_view text);

/// Throws Error::Kind::outOfMemory, naming `what`, if the allocation just made failed.
void checkAllocated(std::string_view what);

/// A named group of commands in debuggers, for as long as it lives.
class DebugGroup {
  public:
    explicit DebugGroup(std::string_view name);
    DebugGroup(const DebugGroup&) = delete;
    DebugGroup& operator=(const DebugGroup&) = delete;
    ~DebugGroup();
};

}  // namespace penumbra::gl
