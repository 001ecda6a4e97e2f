// SPDX-License-Identifier: Apache-2.0
// How many layers lie between each receiver and the light's centre, asked of the triangles themselves: what
// edges change is counted from there (README.md, "Counting layers").
#pragma once

#include "src/techniques/soft_shadow_volumes/caster_clusters.h"

namespace penumbra::soft_shadow_volumes {

class CenterCounts {
  public:
    explicit CenterCounts(Device& device);

    /// Counts for all texels of the V-buffer.
    void count(const VolumeFrame& frame, const FrameBinding& binding, CasterClusters& clusters,
               const Receivers& receivers);

    const gl::Texture& counts() const { return counts_; }  ///< R32UI: two's complement

  private:
    void countBatch(const VolumeFrame& frame, const FrameBinding& binding, CasterClusters& clusters,
                    const Receivers& receivers);

    gl::Program count_;
    gl::Texture counts_;
};

}  // namespace penumbra::soft_shadow_volumes
