// SPDX-License-Identifier: Apache-2.0
// How many layers lie between each receiver and the light's centre, asked of the triangles themselves: what edges
// change is counted from there (README.md, "Counting layers").
#pragma once

#include "src/techniques/soft_shadow_volumes/caster_clusters.h"

namespace penumbra {

class CenterCounts {
  public:
    explicit CenterCounts(Device& device);

    /// Counts for all texels of the V-buffer. The frame's constants and the view must be bound; `tileBounds` says
    /// where the receivers of its small tiles are, `depth` how far they are.
    void count(const VolumeFrame& frame, CasterClusters& clusters, const gl::Buffer& tileBounds,
               const gl::Texture& depth);

    const gl::Texture& counts() const { return counts_; }  ///< R32I

  private:
    void countBatch(const VolumeFrame& frame, CasterClusters& clusters, const gl::Buffer& tileBounds);

    gl::Program count_;
    gl::Texture counts_;
};

}  // namespace penumbra
