// SPDX-License-Identifier: Apache-2.0
// Moments as calendars and clocks have them.
#pragma once

#include <string>
#include <string_view>

namespace penumbra::studio {

struct SunClock {
    int year = 2000, month = 1, day = 1;
    int hour = 0, minute = 0;
    double second = 0;  ///< below 61: there are leap seconds
    int zone_min = 0;   ///< minutes that the clock is ahead of UTC
};

/// "2026-06-21T12:00Z" or with seconds and an offset, "2026-06-21T13:00:30+01:00". Throws InputError "WHERE:
/// ..." for what is no such time, has no zone, or lies outside 1900 to 2100.
SunClock parseSunClock(std::string_view text, const std::string& where);

/// What parseSunClock reads as `clock`, to the second.
std::string textOf(const SunClock& clock);

/// As Julian date - 2400000.5 (UTC).
double utcDaysOf(const SunClock& clock);

/// The clock in UTC, to the nearest second.
SunClock clockOf(double utc_days);

/// 1 is the first of January.
int dayOfYear(const SunClock& clock);
void setDayOfYear(SunClock& clock, int day);

}  // namespace penumbra::studio
