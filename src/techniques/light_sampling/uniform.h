// SPDX-License-Identifier: Apache-2.0
// Uniform light source sampling: a shadow map from each of n x n points of the light, and the mean of their
// hard shadows. M. Schwärzler, O. Mattausch, D. Scherzer, M. Wimmer, Fast Accurate Soft Shadows with Adaptive
// Light Source Sampling (2012), section 3.2 and equation 2; P. Heckbert and M. Herf 1997 before them.
#pragma once

#include "penumbra/technique.h"
#include "src/gl/pass_timers.h"
#include "src/techniques/light_sampling/evaluation.h"

namespace penumbra::light_sampling {

class UniformLightSampling final : public Technique {
  public:
    explicit UniformLightSampling(Device& device);

    void describe(ParameterVisitor& visitor) override;
    void render(const ShadowInputs& inputs, VisibilityBuffer& out) override;
    void inspect(InspectionVisitor& visitor) const override;
    Statistics statistics() const override;

  private:
    void choose(const LightSurface& surface);

    int perSide_ = 17;
    int pattern_ = int(SamplePattern::cells);
    int weights_ = 0;
    int mapSize_px_ = 512;
    int seed_ = 1;
    EvaluationOptions evaluationOptions_;

    std::vector<LightSample> samples_;
    std::vector<glm::vec4> cells_;
    SampleCameras cameras_;
    SampleMaps maps_;
    SampleEvaluation evaluation_;
    RadianceWeights radiance_;
    ViewBinding view_;
    gl::PassTimers timers_;
    int batches_ = 0;
};

}  // namespace penumbra::light_sampling
