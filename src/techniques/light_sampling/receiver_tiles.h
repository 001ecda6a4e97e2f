// SPDX-License-Identifier: Apache-2.0
// Where the picture's receivers are, found on the device: maps have to show no more than what these look up.
#pragma once

#include "src/techniques/light_sampling/evaluation.h"

namespace penumbra::light_sampling {

class ReceiverTiles {
  public:
    explicit ReceiverTiles(Device& device);

    /// Finds all that the light reaches, and compares them with those found before.
    void findAll(const ShadowInputs& inputs, const ViewBinding& view, const SampleCameras& cameras,
                 SampleMaps& maps, const VisibilityBuffer& out);
    /// Finds those that will ask for samples which were not compared. Expects weighed samples. `isKept`:
    /// those found before will do unless findAll has found others.
    void findUnsettled(const ShadowInputs& inputs, const ViewBinding& view, const SampleCameras& cameras,
                       SampleMaps& maps, const SubdivisionPasses& bits, const VisibilityBuffer& out,
                       bool isKept);

    const gl::Buffer& all() const { return all_; }
    const gl::Buffer& unsettled() const { return unsettled_; }
    int count() const { return across_ * down_; }
    /// RedrawGroups: some if the last findAll has found others than the one before.
    const gl::Buffer& redraw() const { return redraw_; }

  private:
    SampleLookup lookup_;
    gl::Buffer all_, unsettled_, redraw_;
    int tile_px_ = 8, across_ = 0, down_ = 0;
};

}  // namespace penumbra::light_sampling
