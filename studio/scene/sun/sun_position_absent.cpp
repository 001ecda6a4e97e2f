// SPDX-License-Identifier: Apache-2.0
// In place of sun_position.cpp in a build for the bench alone, which does without ERFA.
#include "studio/errors.h"
#include "studio/scene/sun/sun.h"

namespace penumbra::studio {

SunPosition sunPosition(const SunPlace&) {
    throw InputError(
        "where the sun stands is not in this build, which is for the bench alone; configure with "
        "PENUMBRA_BENCH_ALONE=OFF");
}

}  // namespace penumbra::studio
