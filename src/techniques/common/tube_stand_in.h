// SPDX-License-Identifier: Apache-2.0
// What stands for a tube where a technique knows only lights that look alike from wherever they are seen.
#pragma once

#include "penumbra/technique.h"

namespace penumbra {

/// The light as a technique gets it: a tube of no size is a point; one for a technique that does not answer
/// tubes is a flat strip through its axis, as long and as wide as the tube, that shines both ways and is
/// turned to the middle of the casters. Every other light is as it was.
AreaLight lightFor(const Technique& technique, const ShadowInputs& inputs);

}  // namespace penumbra
