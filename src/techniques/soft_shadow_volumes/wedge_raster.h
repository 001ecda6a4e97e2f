// SPDX-License-Identifier: Apache-2.0
// Penumbra wedges as the thesis draws them (sections 4.2.3 to 4.2.7): the oracle to which counting layers is
// held.
#pragma once

#include "src/gl/pass_timers.h"
#include "src/gl/texture.h"
#include "src/techniques/soft_shadow_volumes/volume_counter.h"

namespace penumbra {

class WedgeRaster {
  public:
    explicit WedgeRaster(Device& device);

    /// Wedges weigh blockers, not layers: a closed caster hides the light with two layers, an open one with
    /// each. To be called before the frame is counted.
    static void countAsBlockers(VolumeFrame& frame);

    /// Writes visibility into `target`, a texture of the V-buffer's size. The frame's constants, the view and
    /// what `counter` counted must be there.
    void render(const VolumeFrame& frame, const VolumeCounter& counter, GLuint target, GLenum format,
                gl::PassTimers& timers);

    /// The V-buffer's additive and subtractive layer.
    const gl::Texture& layers() const { return layers_; }

  private:
    gl::Program wedges_, resolve_;
    gl::VertexArrayHandle noVertices_;
    gl::Texture layers_;
    gl::Framebuffer framebuffer_;
};

}  // namespace penumbra
