// SPDX-License-Identifier: Apache-2.0
// What a host holds: a technique, with all around it that has nothing to do with shadows: the host's OpenGL
// state, the forms that its view and its texture for the answer may have, and a context that may be gone.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "penumbra/technique.h"
#include "src/hosting/host_view.h"

namespace penumbra {

class HostedTechnique final : public Technique {
  public:
    HostedTechnique(Device& device, std::unique_ptr<Technique> (*make)(Device&));

    void describe(ParameterVisitor& visitor) override;
    void render(const ShadowInputs& inputs, VisibilityBuffer& out) override;
    void renderLights(const FrameInputs& frame) override;
    bool answersAtPoints() const override { return technique_->answersAtPoints(); }
    bool answersTubes() const override { return technique_->answersTubes(); }
    bool answersPanes() const override { return technique_->answersPanes(); }
    void inspect(InspectionVisitor& visitor) const override;
    Statistics statistics() const override;

  private:
    void diagnoseOnce(const FrameInputs& frame);
    void warnOfPolygonOffset(const PolygonOffset& ofHost, const View& view);
    void warnOfTube(const AreaLight& light);
    std::span<const Caster> castersFor(std::span<const Caster> casters);
    VisibilityBuffer& plain(VisibilityBuffer& out, const AreaLight& light, std::size_t place);
    void deliver(const VisibilityBuffer& written, const VisibilityBuffer& out);

    Device device_;  ///< its own: the host may move or destroy the other
    std::unique_ptr<Technique> technique_;
    HostView view_;
    /// For rectangles of the host's textures, formats of its own, and colours that are all the same: by the
    /// light's place in its frame.
    std::deque<std::optional<VisibilityBuffer>> detours_;
    std::vector<FrameLight> lights_;  ///< as the technique gets them
    std::vector<Caster> casters_;     ///< the same, where it does not get the host's
    std::optional<TextureCopy> copy_;
    bool isDiagnosed_ = false;
    bool hasWarnedOfTube_ = false;
    bool hasWarnedOfPanes_ = false;
};

}  // namespace penumbra
