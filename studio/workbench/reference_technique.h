// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "penumbra/technique.h"
#include "src/gl/texture.h"
#include "studio/reference/reference_cache.h"

namespace penumbra::studio {

/// The ray-traced truth behind the interface of the techniques. Reads the view's depth and normals back, so
/// that its rays start from the very positions that the techniques get. Needs normals in the view.
class ReferenceTechnique final : public Technique {
  public:
    void describe(ParameterVisitor& visitor) override;
    void render(const ShadowInputs& inputs, VisibilityBuffer& out) override;
    bool answersAtPoints() const override { return true; }
    bool answersTubes() const override { return true; }
    bool answersPanes() const override { return true; }
    /// "error bound": of each pixel, what it is within in 999 of 1,000.
    void inspect(InspectionVisitor& visitor) const override;
    Statistics statistics() const override;

    /// Called now and then during render with the share that is done.
    void setProgress(std::function<void(double)> progress) { progress_ = std::move(progress); }

  private:
    int samples_ = 256;
    int seed_ = 1;
    int weight_ = 0;
    bool cached_ = true;

    std::function<void(double)> progress_;
    ReferenceResult last_;
    gl::Texture errorBound_;
};

}  // namespace penumbra::studio
