// SPDX-License-Identifier: Apache-2.0
// For hosts that have a framebuffer and no more: no depth texture to hand over, no lighting shader to change.
#pragma once

#include <cstdint>
#include <memory>

#include "penumbra/technique.h"

namespace penumbra {

/// Takes depths out of a host's framebuffers and darkens pictures in them.
class PENUMBRA_API HostFramebuffer {
  public:
    explicit HostFramebuffer(Device& device);
    HostFramebuffer(HostFramebuffer&&) noexcept;
    HostFramebuffer& operator=(HostFramebuffer&&) noexcept;
    ~HostFramebuffer();

    /// Copies the depths of the view's rectangle out of `framebuffer`, and states in `view` what has become
    /// of them: `depthTexture` (the library's, good until the next call) and `samplePlace`.
    ///
    /// `framebuffer`: 0 is the window's own; toolkits that draw elsewhere say so
    /// (`QOpenGLWidget::defaultFramebufferObject()`). Its depths are in a texture or a renderbuffer, 16 to 32
    /// bits, with or without stencil, multisampled or not. Throws Error::Kind::badArgument where it has none,
    /// or where `view.sample` is none of its samples.
    void copyDepth(std::uint32_t framebuffer, View& view);

    /// Multiplies the colours in the view's rectangle of `framebuffer` by the visibility, channel by channel
    /// where the light is textured; alpha stays. `leastLit` in [0, 1] is what is left where nothing of the
    /// light is seen: the share of the picture that other lights made. Depths do not matter; all samples of
    /// a pixel get the same.
    void multiply(std::uint32_t framebuffer, const View& view, const VisibilityBuffer& visibility,
                  float leastLit = 0);

  private:
    struct Internals;
    std::unique_ptr<Internals> internals_;
};

}  // namespace penumbra
