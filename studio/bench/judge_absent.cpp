// SPDX-License-Identifier: Apache-2.0
// In place of judge.cpp in a build for the bench alone, which has no ray-traced truth to judge by.
#include "studio/bench/judge.h"
#include "studio/errors.h"

namespace penumbra::studio {

bool canJudge() {
    return false;
}

Comparison judge(Workbench&, const Scene&, const SceneMoment&, const Camera&, PictureSize,
                 std::span<const Contender>, const JudgeOptions&) {
    throw UsageError("a build for the bench alone has no reference to judge by; take the whole build");
}

}  // namespace penumbra::studio
