// SPDX-License-Identifier: Apache-2.0
#include "src/automatic/budget_keeper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

namespace penumbra {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

BudgetKeeper keeper() {
    return BudgetKeeper({{.error = 0.005, .cost = 9},
                         {.error = 0.02, .cost = 4},
                         {.error = 0.05, .cost = 2},
                         {.error = 0.4, .cost = 1}});
}

/// Runs frames whose steps take what `time_ms` says; the number of changes.
template <typename Time>
int run(BudgetKeeper& keeper, int frames, Time time_ms) {
    int changes = 0;
    for (int i = 0; i < frames; ++i) {
        const std::size_t before = keeper.current();
        keeper.spent(time_ms(before));
        changes += keeper.current() != before;
    }
    return changes;
}

TEST(BudgetKeeper, WithoutABudgetTakesTheCheapestThatKeepsTheError) {
    BudgetKeeper k = keeper();
    for (const auto& [error, step] : {std::pair{0.4, 3u}, {0.1, 2u}, {0.02, 1u}, {0.019, 0u}, {0.001, 0u}}) {
        k.want(error, endless);
        EXPECT_EQ(k.current(), step) << error;
        EXPECT_EQ(run(k, 100, [](std::size_t) { return 1e9; }), 0);
    }
}

TEST(BudgetKeeper, KeepsTheBudgetFromTheThirtiethFrameOn) {
    for (const double budget_ms : {1.2, 2.5, 5.0, 50.0}) {
        BudgetKeeper k = keeper();
        k.want(0.005, budget_ms);
        const auto time_ms = [](std::size_t step) { return std::array{9.0, 4.0, 2.0, 1.0}[step]; };
        run(k, 30, time_ms);
        int kept = 0;
        for (int i = 0; i < 100; ++i) {
            kept += time_ms(k.current()) <= budget_ms;
            k.spent(time_ms(k.current()));
        }
        EXPECT_GE(kept, 95) << budget_ms;
    }
}

TEST(BudgetKeeper, KeepsItThoughFramesDifferAndExpectationsAreWrong) {
    // Frames are up to 12 % off, by a fixed pattern; the second step is dearer than one thinks beforehand.
    const auto time_ms = [](std::size_t step, int frame) {
        return std::array{9.0, 4.0, 3.4, 1.0}[step] * (1 + 0.01 * ((frame * 7) % 25 - 12));
    };
    for (const double budget_ms : {1.2, 2.5, 3.5, 4.1, 5.0, 9.2}) {
        BudgetKeeper k = keeper();
        k.want(0.005, budget_ms);
        int kept = 0;
        for (int i = 0; i < 130; ++i) {
            const double spent_ms = time_ms(k.current(), i);
            kept += i >= 30 && spent_ms <= budget_ms;
            k.spent(spent_ms);
        }
        EXPECT_GE(kept, 95) << budget_ms;
    }
}

TEST(BudgetKeeper, TakesTheBestThatFits) {
    BudgetKeeper k = keeper();
    k.want(0.005, 5.0);
    run(k, 200, [](std::size_t step) { return std::array{9.0, 4.0, 2.0, 1.0}[step]; });
    EXPECT_EQ(k.current(), 1u);
    EXPECT_EQ(k.wanted(), 0u);
}

TEST(BudgetKeeper, RecoversWhereThereIsRoom) {
    BudgetKeeper k = keeper();
    k.want(0.005, 5.0);
    run(k, 100, [](std::size_t step) { return std::array{90.0, 40.0, 20.0, 10.0}[step]; });
    EXPECT_EQ(k.current(), 3u);
    run(k, 200, [](std::size_t step) { return std::array{0.9, 0.4, 0.2, 0.1}[step]; });
    EXPECT_EQ(k.current(), 0u);
}

TEST(BudgetKeeper, LeavesACheapStepThatIsNot) {
    // The last step is the dearest one where it is taken.
    BudgetKeeper k = keeper();
    k.want(0.005, 1.5);
    const auto time_ms = [](std::size_t step) { return std::array{9.0, 7.0, 1.0, 20.0}[step]; };
    EXPECT_LE(run(k, 300, time_ms), 2);
    EXPECT_EQ(k.current(), 2u);
}

TEST(BudgetKeeper, DoesNotSwingWhereExpectationsAreWrong) {
    // The better step looks cheap from the worse one, and is not.
    BudgetKeeper k = keeper();
    k.want(0.02, 3.0);
    const auto time_ms = [](std::size_t step) { return std::array{9.0, 6.0, 1.0, 0.9}[step]; };
    EXPECT_LE(run(k, 1000, time_ms), 3);
    EXPECT_LE(time_ms(k.current()), 3.0);
}

TEST(BudgetKeeper, ChangesOnceInThirtyFramesAtMost) {
    BudgetKeeper k = keeper();
    k.want(0.005, 3.0);
    int lastChange = -1000, closest = 1000;
    for (int i = 0; i < 1000; ++i) {
        const std::size_t before = k.current();
        k.spent((i / 50) % 2 == 0 ? 0.5 : 20.0);
        if (k.current() == before) continue;
        closest = std::min(closest, i - lastChange);
        lastChange = i;
    }
    EXPECT_GE(closest, BudgetKeeper::framesBetweenChanges);
}

}  // namespace
}  // namespace penumbra
