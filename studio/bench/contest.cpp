// SPDX-License-Identifier: Apache-2.0
#include "studio/bench/contest.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <iterator>

#include "studio/bench/device_memory.h"
#include "studio/frame/conversions.h"

namespace penumbra::studio {
namespace {

/// One who competes: made on first use, so that its memory can be told from the others'.
class Competitor {
  public:
    Competitor(Workbench& workbench, const Contender& contender) : workbench_(workbench) {
        result_.contender = contender;
    }

    bool competes(int round, const ContestOptions& options) const {
        return result_.missing.empty() && (round == 0 || spent_ms_ < options.patience_ms);
    }

    /// All lights once. Returns the cost.
    double render(const SceneMoment& moment, std::vector<VisibilityBuffer>& visibilities) {
        const bool first = technique_ == nullptr;
        const std::size_t before_bytes = first ? memoryInUse_bytes() : 0;
        if (first) technique_ = makeIfThere(workbench_, result_.contender, result_.missing);
        if (technique_ == nullptr) return 0;
        const FrameRenderer& frame = workbench_.frame();
        const std::vector<FrameLight> lights = frame.frameLights(moment.lights, visibilities);
        const FrameInputs inputs = frame.frameInputs(lights);
        const double cost_ms = workbench_.clock().milliseconds([&] { technique_->renderLights(inputs); });
        if (first) result_.memory_bytes = memoryInUse_bytes() - before_bytes;
        spent_ms_ += cost_ms;
        return cost_ms;
    }

    /// Renders all lights once more, to ask each what its passes took.
    void takePasses(const SceneMoment& moment, std::vector<VisibilityBuffer>& visibilities) {
        if (technique_ == nullptr) return;
        const FrameRenderer& frame = workbench_.frame();
        const std::vector<FrameLight> lights = frame.frameLights(moment.lights, visibilities);
        FrameInputs inputs = frame.frameInputs(lights);
        inputs.answered = [&](std::size_t) {
            for (const PassTime& pass : technique_->statistics().passes)
                result_.passes_ms[std::string(pass.name)] += pass.milliseconds;
        };
        technique_->renderLights(inputs);
    }

    void count(double cost_ms, double yardstick_ms) {
        cost_ms_.push_back(cost_ms);
        ratios_.push_back(yardstick_ms > 0 ? cost_ms / yardstick_ms : 0);
    }

    ContestResult result() && {
        result_.rounds = int(cost_ms_.size());
        result_.cost_ms = spreadOf(std::move(cost_ms_));
        result_.ratio = spreadOf(std::move(ratios_));
        return std::move(result_);
    }

  private:
    Workbench& workbench_;
    ContestResult result_;
    std::unique_ptr<Technique> technique_;
    std::vector<double> cost_ms_, ratios_;
    double spent_ms_ = 0;
};

/// Everything a ten-thousandth of the scene's size to one side and back, from round to round.
SceneMoment stirred(const SceneMoment& moment, int round) {
    SceneMoment moved = moment;
    const glm::vec3 step(1e-4f * moment.bounds.radius() * float(round & 1), 0, 0);
    for (Instance& instance : moved.instances) {
        instance.worldFromMesh = glm::translate(glm::mat4(1), step) * instance.worldFromMesh;
    }
    for (Light& light : moved.lights) {
        const glm::mat4 worldFromLight = fromPenumbra(light.shape.worldFromLight);
        light.shape.worldFromLight = toPenumbra(glm::translate(glm::mat4(1), step) * worldFromLight);
    }
    return moved;
}

}  // namespace

std::unique_ptr<Technique> makeTechnique(Workbench& workbench, const Contender& contender) {
    std::unique_ptr<Technique> technique = workbench.makeTechnique(contender.technique);
    for (const auto& [name, value] : contender.settings) setParameter(*technique, name, value);
    return technique;
}

std::unique_ptr<Technique> makeIfThere(Workbench& workbench, const Contender& contender,
                                       std::string& missing) {
    try {
        return makeTechnique(workbench, contender);
    } catch (const Error& error) {
        if (error.kind() != Error::Kind::unknownName && error.kind() != Error::Kind::badArgument) throw;
        missing = error.what();
        return nullptr;
    }
}

Spread spreadOf(std::vector<double> values) {
    if (values.empty()) return {};
    std::ranges::sort(values);
    const std::size_t last = values.size() - 1;
    return {.median = values[values.size() / 2], .low = values[last / 4], .high = values[last - last / 4]};
}

std::vector<ContestResult> runContest(Workbench& workbench, const SceneMoment& moment, const Camera& camera,
                                      PictureSize size, std::span<const Contender> contenders,
                                      const ContestOptions& options) {
    std::vector<Competitor> competitors;
    for (const Contender& contender : contenders) competitors.emplace_back(workbench, contender);

    std::vector<VisibilityBuffer> visibilities;
    for (int round = -options.warmUpRounds; round < options.rounds; ++round) {
        const SceneMoment now = options.moving ? stirred(moment, round) : moment;
        workbench.scene().update(now);
        workbench.frame().draw(workbench.scene(), now, camera, size.width_px, size.height_px);
        if (visibilities.empty()) visibilities = workbench.frame().makeVisibilities(now.lights);
        double yardstick_ms = 0;
        for (std::size_t i = 0; i < competitors.size(); ++i) {
            options.progress((double(round + options.warmUpRounds) + double(i) / double(competitors.size())) /
                             (options.rounds + options.warmUpRounds));
            if (!competitors[i].competes(round, options)) continue;
            const double cost_ms = competitors[i].render(now, visibilities);
            if (i == 0) yardstick_ms = cost_ms;
            if (round >= 0) competitors[i].count(cost_ms, yardstick_ms);
            if (round + 1 == options.rounds) competitors[i].takePasses(now, visibilities);
        }
    }
    std::vector<ContestResult> results;
    for (Competitor& competitor : competitors) results.push_back(std::move(competitor).result());
    return results;
}

std::vector<Contender> contendersOf(std::span<const Contender> others) {
    std::vector<Contender> contenders{{.label = "hard", .technique = "hard", .settings = {}}};
    std::ranges::copy_if(others, std::back_inserter(contenders),
                         [](const Contender& other) { return other.label != "hard"; });
    return contenders;
}

}  // namespace penumbra::studio
