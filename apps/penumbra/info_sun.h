// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "studio/scene/open_scene.h"

namespace penumbra::studio {

/// Prints where the sun stands. Throws InputError where it is below the horizon.
void printSun(const SunOption& sun, bool json);

}  // namespace penumbra::studio
