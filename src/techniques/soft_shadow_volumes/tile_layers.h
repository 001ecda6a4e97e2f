// SPDX-License-Identifier: Apache-2.0
// Visibility by counting layers at points of the light, tile by tile (README.md, "Counting layers").
#pragma once

#include <cstddef>

#include "src/gl/pass_timers.h"
#include "src/gl/texture.h"
#include "src/techniques/soft_shadow_volumes/center_counts.h"
#include "src/techniques/soft_shadow_volumes/light_points.h"
#include "src/techniques/soft_shadow_volumes/masked_points.h"
#include "src/techniques/soft_shadow_volumes/volume_counter.h"

namespace penumbra::soft_shadow_volumes {

class TileLayers {
  public:
    explicit TileLayers(Device& device);

    /// How finely, and in what portions.
    struct Effort {
        int samples = 64;                   ///< points of the light, at most LightPoints::most
        int edgeMemory_MiB = 128;           ///< at most; a storage block of the device may hold less
        int roundWork = softwareRoundWork;  ///< loop iterations after which a tile pauses, from 2,000; no
                                            ///< effect on the result
    };
    /// llvmpipe ends all loops of an invocation, without a word, after 65,535 iterations; the last edges
    /// before a pause may take half of that.
    static constexpr int softwareRoundWork = 28'000;
    /// Elsewhere it is watchdogs that want an end.
    static constexpr int hardwareRoundWork = 1'000'000;

    /// Makes room for the frame's edges and tiles, and tells its shaders where they are. Nothing that reads
    /// the frame's constants may have been drawn yet.
    void prepare(VolumeFrame& frame, Effort effort);
    /// Writes visibility into `target`, a texture of the V-buffer's size. `counter` must have the receivers.
    void render(const VolumeFrame& frame, const FrameBinding& binding, const AreaLight& light,
                const VolumeCounter& counter, const gl::TextureRef& target, gl::PassTimers& timers);

    /// How many edges were looked at for each texel.
    const gl::Texture& edgeCounts() const { return edgeCounts_; }
    std::size_t size_bytes() const;
    /// Edges beyond what the memory holds. If there are any, the result is the hard shadow of the light's
    /// centre. Waits for the device where there may be.
    std::size_t edgesWithoutRoom(const VolumeCounter& counter) const;

  private:
    void boundTiles(const VolumeFrame& frame, const FrameBinding& binding, const VolumeCounter& counter);
    void gatherEdges(const VolumeFrame& frame, const FrameBinding& binding, const VolumeCounter& counter);
    void makeResolve();
    void listEdges(const VolumeFrame& frame, const FrameBinding& binding, const VolumeCounter& counter);
    void resolve(const VolumeFrame& frame, const FrameBinding& binding, const VolumeCounter& counter,
                 const gl::TextureRef& target);

    Device::Internals& device_;
    gl::Program gather_, cuts_, boxes_, bounds_, lists_, resolve_;
    CasterClusters clusters_;
    CenterCounts centerCounts_;
    MaskedPoints maskedPoints_;
    LightPoints points_;
    gl::Buffer lightEdges_, wordBoxes_, tileBounds_, tileLists_, states_, rounds_;
    gl::Texture edgeCounts_;
    Effort effort_;
    int resolveSamples_ = 0;  // that `resolve_` was made for
    std::size_t largestBlock_bytes_;
    std::size_t recordCount_ = 0;  // room for LightEdges
    bool isLimited_ = false;       // to less than there may be
};

}  // namespace penumbra::soft_shadow_volumes
