// SPDX-License-Identifier: Apache-2.0
// The sun where and when it stands.
//
// Its apparent place is that of IAU 2006/2000A as ERFA has it (Earth's path, aberration, precession and
// nutation, sidereal time), seen from the place itself, with UT1 = UTC and TT = UTC + 69.184 s: within 0.003
// degrees from 1950 to 2100.
#pragma once

#include <string>
#include <string_view>

#include "studio/scene/scene.h"

namespace penumbra::studio {

/// A place on Earth and a moment there.
struct SunPlace {
    double latitude_deg = 0;   ///< geodetic, north positive, -90 to 90
    double longitude_deg = 0;  ///< east positive, -180 to 180
    double utc_days = 0;       ///< Julian date (UTC) - 2400000.5
};

struct SunPosition {
    double azimuth_deg = 0;             ///< from north, clockwise: east is 90; 0 to 360
    double altitude_deg = 0;            ///< of its centre, without air
    double refracted_altitude_deg = 0;  ///< as air bends its light (Saemundsson 1986), from -1 degree up
    double diameter_deg = 0;            ///< how large it looks
    /// Clear sky, on a surface that faces it: 127.5 klx at 1 AU, e^-0.21 of it for each air mass (IES RP-21;
    /// air mass: Kasten and Young 1989).
    double illuminance_lux = 0;
};

/// Latitude and longitude in degrees. Throws InputError "WHERE: ..." beyond their ranges.
void requirePlace(double latitude_deg, double longitude_deg, const std::string& where);

/// As parseSunClock (sun_clock.h), in days (see SunPlace).
double parseSunTime(std::string_view text, const std::string& where);

/// "LAT,LON,ISO-TIME"; throws InputError "WHERE: ...".
SunPlace parseSunPlace(std::string_view text, const std::string& where);

SunPosition sunPosition(const SunPlace& place);

/// Where a distant light stands: degrees clockwise, seen from above, from -Z, and above the horizon. It
/// shines the other way.
glm::dmat4 worldFromDistantLight(double azimuth_deg, double altitude_deg);

/// Whether some of its disk is above the horizon.
bool isRisen(const SunPosition& position, const SunSetting& setting);

/// Throws InputError "WHERE: ..." where the sun is below the horizon.
void requireRisen(const SunPlace& place, const SunSetting& setting, const std::string& where);

/// A distant light that knows what sun it is (Light::sun). Throws InputError as requireRisen does.
Light sunLight(const std::string& name, const SunPlace& place, const SunSetting& setting,
               const std::string& where);

/// The same, from what a file says. Throws InputError "WHERE: ..." for whatever is wrong with it.
Light sunLight(const std::string& name, const SunOrigin& origin, const std::string& where);

}  // namespace penumbra::studio
