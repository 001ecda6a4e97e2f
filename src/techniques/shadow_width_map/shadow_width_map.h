// SPDX-License-Identifier: Apache-2.0
// Real-time soft shadows using a single light sample (F. Kirsch and J. Döllner, Journal of WSCG 11(1), 2003):
// a map of distances to the shadow's border beside the depth map, from which the penumbra's attenuation
// follows. The published constructions, and an exact one whose penumbra is as wide as the light makes it, on
// both sides of the hard edge.
#pragma once

#include "penumbra/technique.h"
#include "src/gl/pass_timers.h"
#include "src/techniques/common/depth_map.h"
#include "src/techniques/common/view_constants.h"
#include "src/techniques/shadow_width_map/exact_widths.h"
#include "src/techniques/shadow_width_map/published_widths.h"
#include "src/techniques/shadow_width_map/shadow_width_io.h"

namespace penumbra::shadow_width_map {

class ShadowWidthMap final : public Technique {
  public:
    explicit ShadowWidthMap(Device& device);

    void describe(ParameterVisitor& visitor) override;
    void render(const ShadowInputs& inputs, VisibilityBuffer& out) override;
    void inspect(InspectionVisitor& visitor) const override;
    Statistics statistics() const override;

  private:
    enum Mode { exact, compositing, cpuSweep };

    void makeMaps(const ShadowInputs& inputs, const LightSpaceScene& scene,
                  std::span<const LightCamera> cameras);
    void resolve(const ShadowInputs& inputs, const glm::dmat4& lightFromWorld, VisibilityBuffer& out);
    ShadowWidthConstants constants(const AreaLight& light, const glm::dmat3& spaceFromLight) const;

    int mode_ = exact;
    int mapSize_px_ = 1024;
    bool reuseMaps_ = true;

    DepthMap depthMap_;
    ExactWidths exact_;
    PublishedWidths published_;
    gl::ConstantBuffer<ShadowWidthConstants> constants_;
    ViewBinding view_;
    gl::PassTimers timers_;

    LightCameraConstants firstCamera_{};  ///< in its own space
    glm::dmat4 faceFromLight_{1};
    std::vector<double> mapsMadeFrom_;
    int timesMade_ = 0;
};

}  // namespace penumbra::shadow_width_map
