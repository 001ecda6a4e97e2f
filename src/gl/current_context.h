// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace penumbra::gl {

/// One OpenGL context, as the platform library that made it knows it. libepoxy ends the process when OpenGL
/// is called without a context, so that library is asked, and OpenGL is not.
class ContextIdentity {
  public:
    /// Of no context.
    ContextIdentity() = default;
    /// Of the calling thread's current context; of none where there is none.
    static ContextIdentity ofCurrent();

    bool exists() const { return context_ != nullptr; }
    /// On the calling thread.
    bool isCurrent() const { return exists() && getCurrent_() == context_; }

  private:
    using GetCurrentContext = void* (*)();
    GetCurrentContext getCurrent_ = nullptr;
    void* context_ = nullptr;
};

}  // namespace penumbra::gl
