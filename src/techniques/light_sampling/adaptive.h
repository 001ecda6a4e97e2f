// SPDX-License-Identifier: Apache-2.0
// Adaptive light source sampling: M. Schwärzler, O. Mattausch, D. Scherzer, M. Wimmer, Fast Accurate Soft
// Shadows with Adaptive Light Source Sampling (2012). Shadow maps from the light's corners are compared where
// the camera sees them; where their hard shadows are too far apart, the quad between them is split, down to
// 17 x 17 samples.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "penumbra/technique.h"
#include "src/gl/pass_timers.h"
#include "src/techniques/light_sampling/evaluation.h"
#include "src/techniques/light_sampling/published.h"
#include "src/techniques/light_sampling/receiver_tiles.h"
#include "src/techniques/light_sampling/subdivision.h"

namespace penumbra::light_sampling {

class AdaptiveLightSampling final : public Technique {
  public:
    explicit AdaptiveLightSampling(Device& device);

    void describe(ParameterVisitor& visitor) override;
    void render(const ShadowInputs& inputs, VisibilityBuffer& out) override;
    void inspect(InspectionVisitor& visitor) const override;
    Statistics statistics() const override;

  private:
    /// What a frame is made from, for the passes.
    struct Frame {
        const ShadowInputs& inputs;
        glm::dmat4 lightFromWorld;
        VisibilityBuffer& out;
    };

    // What `published` sets beside what its class leaves out.
    bool usesCorners() const { return isPublished_ || lattice_ == 1; }
    bool usesPaperWeights() const { return isPublished_ || weights_ == 1; }
    bool isVolume(const AreaLight& light) const;
    bool countsByQueries(const AreaLight& light) const;
    void renderByQueries(const Frame& frame);

    bool usesBits() const;
    int taps() const;
    SubdivisionOptions treeOptionsFor(const AreaLight& light, int mapSize_px) const;
    SampleMaps::Room roomFor(const AreaLight& light) const;
    void chooseSamples(const AreaLight& light, const LightSurface& surface);
    void renderCenterAlone(const Frame& frame);
    void subdivide(const Frame& frame);
    /// Of maps whose samples stand for quads of a level or deeper ones.
    SampleMaps::Needs needs(int depth) const;
    void drawMaps(int stage, int batch, const char* passName, const SampleMaps::Needs& needs);
    void findReceivers(const Frame& frame);
    void compare(const Frame& frame, int stage, int batch, int round);
    void weigh(const Frame& frame);
    void evaluate(const Frame& frame);
    void evaluateBatch(const Frame& frame, SampleEvaluation::Batch batch);

    Device& device_;
    SubdivisionOptions options_;
    SubdivisionOptions treeOptions_;  // what of them holds for the light at hand
    std::optional<SubdivisionOptions> lastTreeOptions_;
    float comparisonScale_ = 1;
    bool isPublished_ = false;
    int lattice_ = 0, counting_ = 0, emission_ = 0, weights_ = 0;
    float jitter_ = 0;
    int mapSize_px_ = 512;
    bool reuses_ = true;
    bool smooths_ = true;
    EvaluationOptions evaluationOptions_;

    std::vector<LightSample> samples_;
    SampleCameras cameras_;
    SampleMaps maps_;
    ReceiverTiles receivers_;
    SubdivisionPasses subdivision_;
    SampleEvaluation evaluation_;
    RadianceWeights radiance_;
    LatticeShares shares_;
    std::unique_ptr<PublishedSampling> published_;  ///< once asked for
    std::vector<std::byte> key_, lastKey_;
    ViewBinding view_;
    gl::PassTimers timers_;
    bool isCenterAlone_ = false, wasPublished_ = false;
    bool wasStatic_ = false;
};

}  // namespace penumbra::light_sampling
