// SPDX-License-Identifier: Apache-2.0
#include "src/automatic/budget_keeper.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace penumbra {
namespace {

/// Room that a cheaper step has to leave below the budget, and a better one before it is tried: between the
/// two nothing changes.
constexpr double roomBelow = 0.95, roomAbove = 0.8;

/// Weight of the newest frame in the running mean.
constexpr double newest = 0.2;

/// How far a frame may be off the mean where nothing is changing.
constexpr double steadiness = 0.1;

/// Of a normal distribution 95 % lie less than two mean absolute deviations above the mean.
constexpr double deviations = 2;

}  // namespace

BudgetKeeper::BudgetKeeper(std::vector<Step> steps)
    : steps_(std::move(steps)), budget_ms_(std::numeric_limits<double>::infinity()) {
    assert(!steps_.empty());
}

void BudgetKeeper::want(double maxError, double budget_ms) {
    std::size_t wanted = 0;
    while (wanted + 1 < steps_.size() && steps_[wanted + 1].error <= maxError) ++wanted;
    if (wanted == wanted_ && budget_ms == budget_ms_) return;
    wanted_ = wanted;
    budget_ms_ = budget_ms;
    hasChanged_ = false;
    previousMean_ms_ = 0;
    change(wanted_);
}

/// What nineteen in twenty frames of the step are expected not to exceed.
double BudgetKeeper::high_ms(std::size_t step) const {
    return (mean_ms_ + deviations * deviation_ms_) * steps_[step].cost / steps_[current_].cost;
}

/// The most right step that is expected to fit; the cheapest where none is.
std::size_t BudgetKeeper::best(bool isSteady) const {
    for (std::size_t step = wanted_; step < steps_.size(); ++step) {
        if (step < current_ && !isSteady) continue;
        const double room = step == current_ ? 1 : step < current_ ? roomAbove : roomBelow;
        if (high_ms(step) <= room * budget_ms_) return step;
    }
    const auto cheapest =
        std::ranges::min_element(steps_.begin() + std::ptrdiff_t(wanted_), steps_.end(), {}, &Step::cost);
    return std::size_t(cheapest - steps_.begin());
}

void BudgetKeeper::change(std::size_t step) {
    previous_ = current_;
    current_ = step;
    frames_ = 0;
}

void BudgetKeeper::spent(double milliseconds) {
    ++frames_;
    if (frames_ <= framesUnknown()) return;
    if (frames_ == framesUnknown() + 1) {
        mean_ms_ = milliseconds;
        deviation_ms_ = 0;
    }
    deviation_ms_ += newest * (std::abs(milliseconds - mean_ms_) - deviation_ms_);
    mean_ms_ += newest * (milliseconds - mean_ms_);
    if (frames_ < (hasChanged_ ? framesBetweenChanges : framesToStart)) return;
    const bool isSteady = std::abs(milliseconds - mean_ms_) <= steadiness * mean_ms_;
    if (previousMean_ms_ > 0 && isSteady) {
        // What the change has brought is known from now on.
        steps_[current_].cost = steps_[previous_].cost * mean_ms_ / previousMean_ms_;
        previousMean_ms_ = 0;
    }
    const std::size_t step = best(isSteady);
    if (step == current_) return;
    hasChanged_ = true;
    previousMean_ms_ = isSteady ? mean_ms_ : 0;  // another scene's time tells nothing about the step
    change(step);
}

}  // namespace penumbra
