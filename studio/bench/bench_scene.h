// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "studio/scene/scene.h"

namespace penumbra::studio {

struct BenchSceneSpec {
    int triangles = 16'000;  ///< about, >= 576: the casters' together
    int lights = 1;          ///< >= 1
    float lightSize_m = 0.5f;
};

/// Sixteen tori afloat over a ground that only receives, under square lights in a ring: nothing but the
/// numbers asked for differs from one scene to the next.
Scene makeBenchScene(const BenchSceneSpec& spec);

/// What the casters really have.
int trianglesOf(const Scene& scene);

}  // namespace penumbra::studio
