// SPDX-License-Identifier: Apache-2.0
// Casters with holes: which of the light's points they hide from each receiver.
#pragma once

#include "src/techniques/soft_shadow_volumes/caster_clusters.h"
#include "src/techniques/soft_shadow_volumes/light_points.h"

namespace penumbra {

class MaskedPoints {
  public:
    explicit MaskedPoints(Device& device) : device_(device.internals()) {}

    /// Asks all masked casters of the frame. The frame's constants and the view must be bound; `tileBounds` says where
    /// the receivers of small tiles are, `depth` how far they are.
    void mark(const VolumeFrame& frame, CasterClusters& clusters, const LightPoints& points,
              const gl::Buffer& tileBounds, const gl::Texture& depth);

    /// A bit a point, in layers of 32 (R32UI). Only where the frame has masked casters.
    const gl::Texture& hidden() const { return hidden_; }

  private:
    void allocate(glm::ivec2 size_px, int samples);

    Device::Internals& device_;
    gl::Program mark_;
    gl::Texture hidden_;
    int markSamples_ = 0;  // that `mark_` was made for
};

}  // namespace penumbra
