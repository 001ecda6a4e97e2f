// SPDX-License-Identifier: Apache-2.0
// Techniques against the ray-traced truth: what `compare` says, and the errors of `bench` and `reproduce`.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>

#include "studio/bench/contest.h"
#include "studio/report/comparison.h"
#include "studio/workbench/workbench.h"

namespace penumbra::studio {

/// What moves while flicker is measured.
enum class FlickerMotion {
    animation,  ///< the scene's own, at 24 frames a second
    camera,     ///< turns by half a pixel a frame
    light,      ///< all lights move along their X axis, by a five-hundredth of the scene's radius a frame
};

struct JudgeOptions {
    int samples = 256;  ///< rays a pixel of the truth
    int timedRuns = 5;  ///< of each technique and light, in a view that stands still
    std::optional<FlickerMotion> flicker;
    /// Called with each technique after its render, for its intermediate buffers.
    std::function<void(const Contender&, const Technique&)> inspect = [](const Contender&, const Technique&) {
    };
    /// Called with the share that is done and what is being done.
    std::function<void(double, const std::string&)> progress = [](double, const std::string&) {};
};

/// What a technique's flicker is measured over.
inline constexpr int flickerFrames = 8;

/// Whether this build has a truth to judge by: all but those for the bench alone.
bool canJudge();

/// Renders the truth and every contender, and compares. `scene` must be open on `workbench`; `moment` is of
/// it and `camera` of `moment`. Throws penumbra::Error for a technique or parameter that does not exist, and
/// std::runtime_error, naming the pixel, for a visibility that is not finite, and UsageError unless
/// canJudge(). Names of scene and command are left to the caller.
Comparison judge(Workbench& workbench, const Scene& scene, const SceneMoment& moment, const Camera& camera,
                 PictureSize size, std::span<const Contender> contenders, const JudgeOptions& options);

/// `moment` with its camera, `frame` frames later.
struct MovedFrame {
    SceneMoment moment;
    Camera camera;
};
MovedFrame movedFrame(const Scene& scene, const SceneMoment& start, const Camera& camera, PictureSize size,
                      FlickerMotion motion, int frame);

}  // namespace penumbra::studio
