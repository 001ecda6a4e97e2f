// SPDX-License-Identifier: Apache-2.0
// The only place that includes OpenGL, and the base of the owners in this folder.
#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <string_view>
#include <utility>
#include <vector>

#include "src/gl/current_context.h"

namespace penumbra::gl {

/// What a device's objects and frames have in common.
struct ObjectRegistry {
    std::size_t size_bytes = 0;      ///< that objects take
    bool contextLost = false;        ///< names mean nothing any more, and OpenGL must not be called for them
    ContextIdentity context;         ///< that objects belong to; of none: whichever is current
    std::uint64_t newestObject = 0;  ///< objects are numbered as they are made

    /// Objects whose owners were destroyed while the context was not current. They are deleted when it is
    /// used again, or with it.
    struct Orphan {
        void (*destroy)(GLuint);
        GLuint name;
    };
    std::vector<Orphan> orphans;

    /// OpenGL may be called for the objects.
    bool isReachable() const { return !contextLost && (!context.exists() || context.isCurrent()); }

    /// For what a frame needs on the CPU and forgets: it comes back for the next, so that a settled frame
    /// allocates nothing.
    std::pmr::unsynchronized_pool_resource frameMemory;
};

/// While it lives, objects made on this thread are entered in `registry`. The thread's current registry goes
/// with its current context: like that, it is no argument of every constructor.
class ObjectRegistryScope {
  public:
    explicit ObjectRegistryScope(std::shared_ptr<ObjectRegistry> registry);
    ObjectRegistryScope(const ObjectRegistryScope&) = delete;
    ObjectRegistryScope& operator=(const ObjectRegistryScope&) = delete;
    ~ObjectRegistryScope();

    /// Null outside of every scope.
    static const std::shared_ptr<ObjectRegistry>& current();

    /// The current registry's; outside of every scope the standard one.
    static std::pmr::memory_resource* frameMemory();

  private:
    std::shared_ptr<ObjectRegistry> outer_;
};

/// A GL object name that is deleted with its owner. Move-only; 0 is no object.
template <void (*Delete)(GLuint)>
class Handle {
  public:
    Handle() = default;
    explicit Handle(GLuint name)
        : name_(name),
          registry_(ObjectRegistryScope::current()),
          identity_(registry_ ? ++registry_->newestObject : 0) {}
    Handle(Handle&& other) noexcept
        : name_(std::exchange(other.name_, 0)),
          size_bytes_(std::exchange(other.size_bytes_, 0)),
          registry_(std::move(other.registry_)),
          identity_(std::exchange(other.identity_, 0)) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(name_, other.name_);
        std::swap(size_bytes_, other.size_bytes_);
        std::swap(registry_, other.registry_);
        std::swap(identity_, other.identity_);
        return *this;
    }
    ~Handle() {
        if (registry_) registry_->size_bytes -= size_bytes_;
        if (name_ == 0 || (registry_ && registry_->contextLost)) return;
        if (registry_ && !registry_->isReachable()) {
            registry_->orphans.push_back({Delete, name_});
        } else {
            Delete(name_);
        }
    }
    GLuint name() const { return name_; }
    /// Unlike a name it is never given to another object. 0: none is known.
    std::uint64_t identity() const { return identity_; }

    /// Enters the room that the object takes on the device; once.
    void enter(std::size_t size_bytes) {
        if (!registry_) return;
        size_bytes_ = size_bytes;
        registry_->size_bytes += size_bytes;
    }

  private:
    GLuint name_ = 0;
    std::size_t size_bytes_ = 0;
    std::shared_ptr<ObjectRegistry> registry_;
    std::uint64_t identity_ = 0;
};

/// Names an object for debuggers and driver messages: "smoothies/depth".
void label(GLenum kind, GLuint name, std::string_view text);

/// Takes errors that somebody else has left behind, so that `checkAllocated` sees what follows alone.
void forgetErrors();

/// Waits until everything is done. Not for use in a frame, unless the CPU does the drawing.
void finish();

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
