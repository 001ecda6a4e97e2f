// SPDX-License-Identifier: Apache-2.0
// Points of the light that stand for what is around them.
#pragma once

#include "penumbra/light.h"
#include "src/device/device_internals.h"
#include "src/gl/buffer.h"
#include "src/gl/pass.h"
#include "src/techniques/soft_shadow_volumes/volume_frame.h"

namespace penumbra::soft_shadow_volumes {

class LightPoints {
  public:
    explicit LightPoints(Device& device);

    static constexpr int most = 1024;

    /// Spreads `count` points over the light's unit square or disk, twice as many where it is textured, but
    /// no more than `most`; and finds what a textured light radiates around each.
    void place(const AreaLight& light, const FrameBinding& binding, int count);

    /// Of the light they were last placed on.
    int count() const { return count_; }
    /// Of these, what the pass's shaders declare: `Samples`, their places; `Radiances`, what a textured light
    /// radiates around them; and `lightTable`, what it radiates beyond each place on it.
    void bindTo(gl::Pass& pass) const;

  private:
    gl::Program radiance_, makeTable_;
    gl::Texture table_;
    gl::Buffer places_, radiances_;
    int count_ = 0;
    bool onSquare_ = false;
};

}  // namespace penumbra::soft_shadow_volumes
