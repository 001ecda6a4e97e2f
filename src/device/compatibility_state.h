// SPDX-License-Identifier: Apache-2.0
// What compatibility contexts have besides, and what of it changes what shaders draw or what is copied.
#pragma once

#include <array>

#include "src/gl/gl.h"

namespace penumbra {

bool isCompatibilityContext();

/// The defaults of all of it. In core contexts, which have none of it, nothing is called.
void setKnownCompatibilityState();

/// Remembers all of it at construction and puts it back when destroyed.
class CompatibilityState {
  public:
    CompatibilityState();
    CompatibilityState(const CompatibilityState&) = delete;
    CompatibilityState& operator=(const CompatibilityState&) = delete;
    ~CompatibilityState();

  private:
    static constexpr std::size_t capabilities = 4;
    static constexpr std::size_t transfers = 14;

    bool exists_;
    std::array<bool, capabilities> enabled_{};
    std::array<GLfloat, transfers> transfer_{};
    GLint clampFragmentColor_ = GL_FIXED_ONLY;
};

}  // namespace penumbra
