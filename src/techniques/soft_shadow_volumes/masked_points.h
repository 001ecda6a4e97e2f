// SPDX-License-Identifier: Apache-2.0
// Casters with holes: which of the light's points they hide from each receiver.
#pragma once

#include "src/techniques/soft_shadow_volumes/caster_clusters.h"
#include "src/techniques/soft_shadow_volumes/light_points.h"

namespace penumbra::soft_shadow_volumes {

class MaskedPoints {
  public:
    explicit MaskedPoints(Device& device) : device_(internalsOf(device)) {}

    /// Asks all masked casters of the frame.
    void mark(const VolumeFrame& frame, const FrameBinding& binding, CasterClusters& clusters,
              const LightPoints& points, const Receivers& receivers);

    /// A bit a point, in layers of 32 (R32UI).
    const gl::Texture& hidden() const { return hidden_; }

  private:
    void fitHidden(glm::ivec2 size_px, int words);
    void allocate(glm::ivec2 size_px, int samples);

    Device::Internals& device_;
    gl::Program mark_;
    gl::Texture hidden_;
    int markSamples_ = 0;  // that `mark_` was made for
};

}  // namespace penumbra::soft_shadow_volumes
