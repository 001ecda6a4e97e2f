// SPDX-License-Identifier: Apache-2.0
// Triangles of casters in light space, in clusters with boxes around them, and for each large tile of the
// V-buffer a list of the clusters that may lie between its receivers and the light.
#pragma once

#include "src/device/device_internals.h"
#include "src/gl/buffer.h"
#include "src/gl/program.h"
#include "src/techniques/soft_shadow_volumes/volume_frame.h"

namespace penumbra::soft_shadow_volumes {

/// Where the receivers are.
struct Receivers {
    const gl::Buffer& tileBounds;  ///< of small tiles
    const gl::Texture& depths;     ///< of each texel, lifted (lifted_receiver.glsl)

    void bindTo(gl::Pass& pass) const { pass.bind("Bounds", tileBounds).bind("liftedDepths", depths); }
};

class CasterClusters {
  public:
    explicit CasterClusters(Device& device);

    /// How many clusters a mesh has. Those of a batch are at most `largestBatch`: 64 MiB of triangles.
    static unsigned countOf(const Mesh& mesh);
    static constexpr unsigned largestBatch = (64u << 20) / (clusterTriangles * sizeof(LightTriangle));

    /// Makes room for all that the frame may add at a time.
    void allocate(const VolumeFrame& frame);
    void clear() { count_ = 0; }
    /// Adds clusters of a mesh, from the one with `firstTriangle` on, as many as fit; returns how many.
    unsigned add(const FrameBinding& binding, const Mesh& mesh, const MeshConstants& part);
    unsigned count() const { return count_; }
    bool isFull() const { return count_ == largestBatch; }

    enum class Towards { center, light };
    /// Lists what has been added. `tileBounds`: where the receivers of small tiles are.
    void list(const VolumeFrame& frame, const FrameBinding& binding, const gl::Buffer& tileBounds,
              Towards towards);
    /// `Clusters`, their `Triangles` and the `Lists`.
    void bindTo(gl::Pass& pass) const;

    std::size_t size_bytes() const;

  private:
    gl::Program gather_, lists_;
    gl::Buffer triangles_, clusters_, clusterLists_;
    unsigned count_ = 0;
};

}  // namespace penumbra::soft_shadow_volumes
