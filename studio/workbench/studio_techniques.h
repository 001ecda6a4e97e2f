// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>

#include "penumbra/technique.h"

namespace penumbra::studio {

struct StudioTechnique {
    TechniqueInfo info;
    std::unique_ptr<Technique> (*make)();
};

/// Techniques that are of the studio and not of the library: the ray-traced reference; none in a build for
/// the bench alone.
std::span<const StudioTechnique> studioTechniques();

}  // namespace penumbra::studio
