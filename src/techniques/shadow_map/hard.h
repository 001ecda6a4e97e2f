// SPDX-License-Identifier: Apache-2.0
// Casting curved shadows on curved surfaces (L. Williams, SIGGRAPH 1978): a point is lit if it is the nearest
// one that the light's centre sees. No penumbra; the yardstick of cost for everything else.
#pragma once

#include <array>

#include "penumbra/promise.h"
#include "penumbra/technique.h"
#include "src/gl/pass_timers.h"
#include "src/gl/program.h"
#include "src/techniques/common/depth_map.h"
#include "src/techniques/common/view_constants.h"

namespace penumbra::shadow_map {

class HardShadowMap final : public Technique {
  public:
    static constexpr std::array promises = {Promise{{}, {}, 0.5f, 1.0f}};

    explicit HardShadowMap(Device& device);

    void describe(ParameterVisitor& visitor) override;
    void render(const ShadowInputs& inputs, VisibilityBuffer& out) override;
    void inspect(InspectionVisitor& visitor) const override;
    Statistics statistics() const override;

  private:
    int mapSize_px_ = 2048;

    DepthMap depthMap_;
    gl::Program resolve_;
    ViewBinding view_;
    gl::PassTimers timers_;
};

}  // namespace penumbra::shadow_map
