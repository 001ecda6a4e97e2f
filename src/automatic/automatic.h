// SPDX-License-Identifier: Apache-2.0
// `auto`: for a light and a frame the cheapest technique, and its settings, that keep a promise; the
// techniques state what they promise (penumbra/promise.h), and nothing here knows any of them.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "penumbra/promise.h"
#include "penumbra/technique.h"
#include "src/automatic/budget_keeper.h"
#include "src/automatic/frame_watch.h"
#include "src/device/device_internals.h"
#include "src/gl/pass_timers.h"

namespace penumbra {

class Automatic final : public Technique {
  public:
    /// Another technique as it can be taken.
    struct Candidate {
        std::string_view technique;
        std::unique_ptr<Technique> (*make)(Device&);
        Promise promise;
    };

    Automatic(Device& device, std::vector<Candidate> candidates);

    void describe(ParameterVisitor& visitor) override;
    /// Throws Error::Kind::badArgument where the error asked for is less than anybody promises.
    void render(const ShadowInputs& inputs, VisibilityBuffer& out) override;
    /// Passed on; with a budget light by light, since each one's time counts.
    void renderLights(const FrameInputs& frame) override;
    /// Through those that do.
    bool answersAtPoints() const override { return true; }
    bool answersTubes() const override { return true; }
    bool answersPanes() const override { return true; }
    void inspect(InspectionVisitor& visitor) const override;
    Statistics statistics() const override;

  private:
    /// What not every technique answers.
    struct Asked {
        bool points, tubes, panes;
        bool isAnsweredBy(const Technique& technique) const;
        std::string words() const;
    };

    void requirePromise() const;
    bool hasBudget() const;
    static Asked askedOf(const View& view, const FrameLight& one);
    std::size_t stepFor(const Asked& asked);
    Technique& take(std::size_t step);
    Technique& technique(std::string_view name) const;  ///< one that was made
    void measure(const ShadowInputs& inputs, VisibilityBuffer& out, Technique& technique);
    void endFrame();

    float maxError_ = defaultMaxError;
    float budget_ms_;

    Device& device_;
    std::vector<Candidate> candidates_;  ///< none is both dearer and less right than another one
    BudgetKeeper keeper_;
    std::vector<std::pair<std::string_view, std::unique_ptr<Technique>>> made_;
    std::optional<std::size_t> taken_;  ///< of the last render

    // Only with a budget.
    FrameWatch frames_;
    std::deque<gl::PassTimers> timers_;  ///< one for each light of a frame
    std::vector<double> lights_ms_;      ///< of this frame, as far as one knows
};

}  // namespace penumbra
