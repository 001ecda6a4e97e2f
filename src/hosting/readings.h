// SPDX-License-Identifier: Apache-2.0
// What a host may have meant: its inputs as they stand, and as they would be without one common mistake.
#pragma once

#include <string>
#include <vector>

#include "src/hosting/caster_picture.h"

namespace penumbra {

struct OtherReading {
    std::string finding;  ///< if it fits: what is wrong, and what to do
    Reading reading;
};

/// As stated.
Reading readingOf(const View& view, std::span<const Caster> casters);

/// The likeliest first, of those that fit equally well.
std::vector<OtherReading> otherReadings(const Reading& stated, int width_px, int height_px);

}  // namespace penumbra
