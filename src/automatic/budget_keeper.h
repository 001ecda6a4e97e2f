// SPDX-License-Identifier: Apache-2.0
// Which of several ways to do something to take, so that an error is kept as long as a time allows it. Knows
// nothing of shadows, and calls no clock: it is told what each frame took.
#pragma once

#include <cstddef>
#include <vector>

namespace penumbra {

class BudgetKeeper {
  public:
    struct Step {
        double error;
        double cost;  ///< relative to the others', as far as one knows beforehand
    };

    /// The steps from the most right to the cheapest: errors grow, costs fall. At least one.
    explicit BudgetKeeper(std::vector<Step> steps);

    /// What is wanted from now on. `budget_ms` may be infinite.
    void want(double maxError, double budget_ms);

    /// The cheapest step that keeps the error; the first where none does.
    std::size_t wanted() const { return wanted_; }
    /// The step for the next frame: the wanted one, or a cheaper one where that takes too long.
    std::size_t current() const { return current_; }

    /// Tells what the last frame took. A step changes at most once in `framesBetweenChanges`, so that a
    /// steady scene is not seen to switch to and fro; what a change has been seen to bring is remembered.
    void spent(double milliseconds);

    /// A running mean of the current step's time, once it has settled; 0 before.
    double measured_ms() const { return frames_ > framesUnknown() ? mean_ms_ : 0; }

    static constexpr int framesToSettle = 5;  ///< times that lag behind the frame are another step's
    static constexpr int framesToStart =
        4;  ///< after which the first change may come; drivers compile in two
    static constexpr int framesBetweenChanges = 30;

  private:
    void change(std::size_t step);
    int framesUnknown() const { return hasChanged_ ? framesToSettle : framesToStart - 2; }
    double high_ms(std::size_t step) const;
    std::size_t best(bool isSteady) const;

    std::vector<Step> steps_;
    double budget_ms_;
    std::size_t wanted_ = 0, current_ = 0, previous_ = 0;
    double mean_ms_ = 0, deviation_ms_ = 0, previousMean_ms_ = 0;
    int frames_ = 0;  ///< since the last change
    bool hasChanged_ = false;
};

}  // namespace penumbra
