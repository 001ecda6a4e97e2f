// SPDX-License-Identifier: Apache-2.0
// The sun over a day at a place.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "studio/scene/scene.h"
#include "studio/scene/sun/sun.h"

namespace penumbra::studio {

/// The sun at one time of the day.
struct SunMoment {
    std::string clock;  ///< "08:15", local
    double hour = 0;    ///< since midnight
    SunPosition position;
    std::optional<Light> light;  ///< none while it is below the horizon
    std::string place;           ///< "LAT,LON,ISO-TIME" of this moment
};

/// `over` is "08:00-18:00", or with a step "08:00-18:00/15min" (or /1h; 15 minutes without one); `place` is
/// "LAT,LON,ISO-TIME" as --sun has it, of which the day and the zone are taken. The first and the last time
/// are in it. Throws InputError "--over: ..." or "--sun: ..." for what is neither, and where the sun is below
/// the horizon all the time.
std::vector<SunMoment> sunDay(std::string_view over, std::string_view place, const SunSetting& setting);

/// How much of a day each moment stands for, in hours: half of the steps around it.
std::vector<double> hoursOf(const std::vector<SunMoment>& day);

}  // namespace penumbra::studio
