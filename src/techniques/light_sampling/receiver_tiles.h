// SPDX-License-Identifier: Apache-2.0
// Where the picture's receivers are, found on the device: maps have to show no more than what these look up.
#pragma once

#include "src/techniques/light_sampling/evaluation.h"

namespace penumbra {

class ReceiverTiles {
  public:
    explicit ReceiverTiles(Device& device);

    /// Finds all that the light reaches. Expects the view to be bound. What has been found before stays to be
    /// compared with: see `stale`.
    void findAll(const ShadowInputs& inputs, const SampleCameras& cameras, const SampleMaps& maps,
                 const VisibilityBuffer& out);
    /// Finds those that will ask for samples which were not compared. Expects, besides, weighed samples and what
    /// settled.glsl reads at texture unit 4 and storage block 5.
    void findUnsettled(const ShadowInputs& inputs, const SampleCameras& cameras, const SampleMaps& maps,
                       const VisibilityBuffer& out);

    const gl::Buffer& all() const { return all_; }
    const gl::Buffer& unsettled() const { return unsettled_; }
    int count() const { return across_ * down_; }
    /// A number: whether the last findAll has found others than the one before.
    const gl::Buffer& stale() const { return stale_; }

  private:
    void dispatch(const gl::Buffer& tiles, const SampleMaps& maps);

    SampleLookup lookup_;
    gl::Buffer all_, unsettled_, stale_;
    int tile_px_ = 8, across_ = 0, down_ = 0;
};

}  // namespace penumbra
