// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "src/gl/gl.h"

namespace penumbra::gl {

/// Tells without waiting whether the device has come past a point in its work.
class Fence {
  public:
    Fence() = default;
    Fence(const Fence&) = delete;
    Fence& operator=(const Fence&) = delete;
    ~Fence() { remove(); }

    /// The point is behind all that was asked of the device so far.
    void set() {
        remove();
        sync_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
        registry_ = ObjectRegistryScope::current();
    }
    /// False, too, where it was never set.
    bool hasPassed() const {
        if (sync_ == nullptr) return false;
        const GLenum state = glClientWaitSync(sync_, 0, 0);
        return state == GL_ALREADY_SIGNALED || state == GL_CONDITION_SATISFIED;
    }

  private:
    void remove() {
        // What cannot be deleted goes with its context.
        if (sync_ != nullptr && (!registry_ || registry_->isReachable())) glDeleteSync(sync_);
        sync_ = nullptr;
    }

    GLsync sync_ = nullptr;
    std::shared_ptr<ObjectRegistry> registry_;
};

}  // namespace penumbra::gl
