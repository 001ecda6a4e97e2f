// SPDX-License-Identifier: Apache-2.0
// Rendering antialiased shadows with depth maps (W. T. Reeves, D. H. Salesin, R. L. Cook, SIGGRAPH 1987):
// percentage- closer filtering with kernels of fixed size in the map, which soften the edge but know nothing
// of the light's size.
#pragma once

#include "penumbra/technique.h"
#include "src/gl/buffer.h"
#include "src/gl/pass_timers.h"
#include "src/gl/program.h"
#include "src/techniques/common/depth_map.h"
#include "src/techniques/common/view_constants.h"

namespace penumbra::shadow_map {

class Pcf final : public Technique {
  public:
    explicit Pcf(Device& device);

    void describe(ParameterVisitor& visitor) override;
    void render(const ShadowInputs& inputs, VisibilityBuffer& out) override;
    void inspect(InspectionVisitor& visitor) const override;
    Statistics statistics() const override;

  private:
    enum class Kernel { bilinear, tent3, tent5, bicubic, poisson };  ///< numbered as in shadow_map_io.h

    /// How far from the receiver's place the kernel reaches.
    double reach_px() const;

    int mapSize_px_ = 2048;
    int kernel_ = int(Kernel::tent3);
    float radius_px_ = 4;

    DepthMap depthMap_;
    gl::Program resolve_;
    ViewBinding view_;
    gl::StorageArray<glm::vec2> poissonDisk_;
    gl::PassTimers timers_;
};

}  // namespace penumbra::shadow_map
