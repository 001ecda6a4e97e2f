// SPDX-License-Identifier: Apache-2.0
// Where frames begin. A technique is asked for one light after the other and not told which of them share a
// frame; a budget, though, is for all lights of one.
#pragma once

#include <cstdint>
#include <vector>

#include "penumbra/technique.h"

namespace penumbra {

class FrameWatch {
  public:
    /// Whether the render that is asked for is the first of a frame: the view or a caster is not what it was
    /// for the last light, or this light has had its turn, where it is or less than its own size away.
    bool begins(const ShadowInputs& inputs);

    /// Renders of this frame so far, with the one that was told last.
    std::size_t lights() const { return lights_.size(); }

  private:
    struct Placed {
        std::uint64_t mesh, revision;
        Mat4 worldFromMesh;
        bool operator==(const Placed&) const = default;
    };
    bool hasStageChanged(const ShadowInputs& inputs);

    std::uint32_t depthTexture_ = 0;
    Mat4 viewFromWorld_, clipFromView_;
    std::vector<Placed> casters_, casting_;  ///< of the last render, and room for this one's
    std::vector<AreaLight> lights_;
};

}  // namespace penumbra
