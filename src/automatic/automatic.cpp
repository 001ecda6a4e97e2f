// SPDX-License-Identifier: Apache-2.0
#include "src/automatic/automatic.h"

#include <algorithm>
#include <ctime>
#include <limits>
#include <numeric>
#include <string>

namespace penumbra {
namespace {

/// By error, without those that another one beats in both.
std::vector<Automatic::Candidate> worthwhile(std::vector<Automatic::Candidate> all) {
    std::ranges::stable_sort(all, {}, [](const auto& candidate) {
        return std::pair(candidate.promise.penumbraRmse, candidate.promise.cost);
    });
    std::vector<Automatic::Candidate> result;
    for (const Automatic::Candidate& candidate : all) {
        if (result.empty() || candidate.promise.cost < result.back().promise.cost)
            result.push_back(candidate);
    }
    return result;
}

std::vector<BudgetKeeper::Step> stepsOf(std::span<const Automatic::Candidate> candidates) {
    std::vector<BudgetKeeper::Step> steps;
    for (const auto& [technique, make, promise] : candidates)
        steps.push_back({.error = promise.penumbraRmse, .cost = promise.cost});
    return steps;
}

double processTime_ms() {
    return 1e3 * double(std::clock()) / CLOCKS_PER_SEC;
}

std::string shortest(double value) {
    std::string text = std::to_string(value);
    return text.substr(0, text.find_last_not_of('0') + 1);
}

}  // namespace

Automatic::Automatic(Device& device, std::vector<Candidate> candidates)
    : budget_ms_(std::numeric_limits<float>::infinity()),
      device_(device),
      candidates_(worthwhile(std::move(candidates))),
      keeper_(stepsOf(candidates_)) {}

void Automatic::describe(ParameterVisitor& visitor) {
    constexpr float leastError = 1e-6f, leastBudget_ms = 1e-3f;
    visitor.real(
        {.name = "max_error",
         .help = "root mean square error of visibility in the penumbra that is kept; what takes the least "
                 "time for it is taken"},
        maxError_, {leastError, 1});
    visitor.real(
        {.name = "budget_ms",
         .unit = "ms",
         .help = "device time that a frame's lights may take together in a steady state (process time where "
                 "the driver renders in software); where it does not suffice, the error gives way"},
        budget_ms_, {leastBudget_ms, std::numeric_limits<float>::infinity()});
}

Technique& Automatic::technique(std::string_view name) const {
    return *std::ranges::find(made_, name, [](const auto& entry) { return entry.first; })->second;
}

Technique& Automatic::take(std::size_t step) {
    const auto& [name, make, promise] = candidates_[step];
    if (std::ranges::find(made_, name, [](const auto& entry) { return entry.first; }) == made_.end())
        made_.emplace_back(name, make(device_));
    Technique& taken = technique(name);
    if (taken_ != step) {
        if (!promise.parameter.empty()) setParameter(taken, promise.parameter, promise.value);
        for (const Setting& setting : promise.besides) setParameter(taken, setting.parameter, setting.value);
    }
    taken_ = step;
    return taken;
}

bool Automatic::Asked::isAnsweredBy(const Technique& technique) const {
    return (!points || technique.answersAtPoints()) && (!tubes || technique.answersTubes()) &&
           (!panes || technique.answersPanes());
}

std::string Automatic::Asked::words() const {
    return std::string(points ? " at points" : "") + (tubes ? " tubes" : "") + (panes ? " panes" : "");
}

/// Whose turn it is; where that one does not answer what is asked, of those that do the cheapest that keeps
/// the error: a dearer one errs less. Points have no steady state whose time could be kept.
std::size_t Automatic::stepFor(const Asked& asked) {
    const std::size_t current = keeper_.current();
    if (!asked.points && asked.isAnsweredBy(take(current))) return current;
    for (std::size_t step = keeper_.wanted() + 1; step-- > 0;) {
        if (asked.isAnsweredBy(take(step))) return step;
    }
    throw Error(Error::Kind::badArgument, "auto: no technique answers" + asked.words() + " with max_error " +
                                              shortest(maxError_) + ": take another than auto");
}

bool Automatic::hasBudget() const {
    return budget_ms_ < std::numeric_limits<float>::infinity();
}

void Automatic::requirePromise() const {
    if (candidates_.front().promise.penumbraRmse <= maxError_) return;
    throw Error(Error::Kind::badArgument, "max_error: no technique promises less than " +
                                              shortest(candidates_.front().promise.penumbraRmse) + ", not " +
                                              shortest(maxError_));
}

/// What of a light not every technique answers. A colored buffer without a picture is one for panes.
Automatic::Asked Automatic::askedOf(const View& view, const FrameLight& one) {
    return {.points = view.isOfPoints,
            .tubes = one.light.shape == LightShape::cylinder,
            .panes = one.out->colored() && one.light.radianceTexture == 0};
}

void Automatic::render(const ShadowInputs& inputs, VisibilityBuffer& out) {
    requirePromise();
    const bool keepsTime = hasBudget() && !inputs.view.isOfPoints;
    if (hasBudget() && frames_.begins(inputs)) endFrame();
    keeper_.want(maxError_, budget_ms_);
    Technique& technique = take(stepFor(askedOf(inputs.view, {.light = inputs.light, .out = &out})));
    if (keepsTime) {
        measure(inputs, out, technique);
    } else {
        technique.render(inputs, out);
    }
}

void Automatic::renderLights(const FrameInputs& frame) {
    if (hasBudget()) return Technique::renderLights(frame);
    requirePromise();
    keeper_.want(maxError_, budget_ms_);
    // Those that stand side by side and have one technique at once.
    const auto stepOf = [&](const FrameLight& one) { return stepFor(askedOf(frame.view, one)); };
    for (auto begin = frame.lights.begin(); begin != frame.lights.end();) {
        const std::size_t step = stepOf(*begin);
        const auto end = std::find_if(begin, frame.lights.end(),
                                      [&](const FrameLight& one) { return stepOf(one) != step; });
        FrameInputs part{.view = frame.view, .casters = frame.casters, .lights = {begin, end}};
        const auto before = std::size_t(begin - frame.lights.begin());
        if (frame.answered) part.answered = [&frame, before](std::size_t i) { frame.answered(before + i); };
        take(step).renderLights(part);
        begin = end;
    }
}

/// All lights of a frame take the same step: each gets the time that it needs for the same error.
void Automatic::endFrame() {
    const double frame_ms = std::accumulate(lights_ms_.begin(), lights_ms_.end(), 0.0);
    if (frame_ms > 0) keeper_.spent(frame_ms);
    lights_ms_.clear();
}

void Automatic::measure(const ShadowInputs& inputs, VisibilityBuffer& out, Technique& technique) {
    if (device_.isSoftware()) {
        // The processor draws: to wait for it costs nothing, and its time is what has been spent.
        gl::finish();
        const double start_ms = processTime_ms();
        technique.render(inputs, out);
        gl::finish();
        lights_ms_.push_back(processTime_ms() - start_ms);
        return;
    }
    while (timers_.size() < frames_.lights()) timers_.emplace_back();
    gl::PassTimers& timer = timers_[frames_.lights() - 1];
    {
        const auto pass = timer.pass("auto/light");
        technique.render(inputs, out);
    }
    lights_ms_.push_back(timer.latest().front().milliseconds);
}

void Automatic::inspect(InspectionVisitor& visitor) const {
    if (taken_) technique(candidates_[*taken_].technique).inspect(visitor);
}

Statistics Automatic::statistics() const {
    if (!taken_) return {};
    const Candidate& candidate = candidates_[*taken_];
    Statistics statistics = technique(candidate.technique).statistics();
    std::vector<Statistic> own = {
        {.name = "error asked for", .value = maxError_},
        {.name = "error promised", .value = candidate.promise.penumbraRmse},
    };
    if (budget_ms_ < std::numeric_limits<float>::infinity()) {
        own.push_back({.name = "budget", .value = budget_ms_, .unit = "ms"});
        own.push_back({.name = "spent", .value = keeper_.measured_ms(), .unit = "ms"});
        own.push_back({.name = "error gave way to the budget", .value = double(*taken_ > keeper_.wanted())});
        own.push_back({.name = "budget gave way", .value = double(keeper_.measured_ms() > budget_ms_)});
    }
    statistics.counts.insert(statistics.counts.begin(), own.begin(), own.end());
    statistics.chosen = {.technique = candidate.technique,
                         .parameter = candidate.promise.parameter,
                         .value = candidate.promise.value};
    return statistics;
}

}  // namespace penumbra
