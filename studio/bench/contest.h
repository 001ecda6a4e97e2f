// SPDX-License-Identifier: Apache-2.0
// What techniques cost on one situation, measured so that a drift of the machine's speed meets all alike.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "studio/workbench/workbench.h"

namespace penumbra::studio {

/// A technique with the parameters that it competes with.
struct Contender {
    std::string label;
    std::string technique;
    std::vector<std::pair<std::string, std::string>> settings;
};

/// Makes a contender's technique and sets its parameters. Throws penumbra::Error.
std::unique_ptr<Technique> makeTechnique(Workbench& workbench, const Contender& contender);

/// The same, but nothing where the technique or a parameter does not exist: `missing` says which.
std::unique_ptr<Technique> makeIfThere(Workbench& workbench, const Contender& contender,
                                       std::string& missing);

/// Of repeated measurements. All 0 of none.
struct Spread {
    double median = 0;
    double low = 0, high = 0;  ///< quartiles
};
Spread spreadOf(std::vector<double> values);

struct ContestResult {
    Contender contender;
    std::string missing;  ///< why it could not compete (no such technique or parameter yet); else empty
    Spread cost_ms;       ///< of a frame, all lights together, on the workbench's clock
    Spread ratio;         ///< to `hard` in the same round
    int rounds = 0;       ///< measured; fewer than asked for if patience ended
    std::map<std::string, double>
        passes_ms;  ///< device timestamps after the last round, all lights together; none if patience ended
    std::size_t memory_bytes = 0;  ///< textures and buffers that it holds on the device
};

struct ContestOptions {
    int rounds = 9;
    int warmUpRounds = 2;
    /// Everything moves a little from round to round, so that nothing can be kept. False: all stands still,
    /// and what a technique keeps between frames counts for it.
    bool moving = true;
    /// Whoever has taken so much in all renders no more; each has at least one measured round.
    double patience_ms = 60e3;
    /// Called with the share that is done.
    std::function<void(double)> progress = [](double) {};
};

/// Rounds in which every contender renders all lights of `moment` once, after some to warm up. The
/// first contender is the yardstick that ratios go by: `hard`. The scene of `moment` must be open.
std::vector<ContestResult> runContest(Workbench& workbench, const SceneMoment& moment, const Camera& camera,
                                      PictureSize size, std::span<const Contender> contenders,
                                      const ContestOptions& options);

/// The contenders for a bench: `hard` first, with its defaults, then `others` but for one that is called so,
/// too.
std::vector<Contender> contendersOf(std::span<const Contender> others);

}  // namespace penumbra::studio
