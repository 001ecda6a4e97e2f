// SPDX-License-Identifier: Apache-2.0
// Variance shadow maps (W. Donnelly, A. Lauritzen, I3D 2006): a map that can be filtered, since it stores
// moments.
#pragma once

#include "penumbra/technique.h"
#include "src/gl/pass_timers.h"
#include "src/gl/program.h"
#include "src/gl/texture.h"
#include "src/techniques/common/depth_map.h"
#include "src/techniques/common/view_constants.h"

namespace penumbra::variance_map {

class Variance final : public Technique {
  public:
    explicit Variance(Device& device);

    void describe(ParameterVisitor& visitor) override;
    void render(const ShadowInputs& inputs, VisibilityBuffer& out) override;
    void inspect(InspectionVisitor& visitor) const override;
    Statistics statistics() const override;

  private:
    void filter();

    int mapSize_px_ = 1024;
    int radius_px_ = 8;

    DepthMap depthMap_;
    gl::Texture across_, moments_;
    gl::Program filter_, resolve_;
    ViewBinding view_;
    gl::PassTimers timers_;
};

}  // namespace penumbra::variance_map
