// SPDX-License-Identifier: Apache-2.0
#include <erfa.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "studio/scene/sun/sun.h"

namespace penumbra::studio {
namespace {

constexpr double radians = std::numbers::pi / 180;
constexpr double metresPerAu = 149597870700.0;
constexpr double sunRadius_m = 695.7e6;  // IAU 2015 B3
constexpr double secondsPerDay = 86400, ttMinusUtc_s = 69.184;
constexpr double lightDaysPerAu = 499.004784 / secondsPerDay;
constexpr double modifiedJulianZero = 2400000.5;

glm::dvec3 vector(const double (&v)[3]) {
    return {v[0], v[1], v[2]};
}

/// From the Earth's centre to the sun, in AU, as it is seen: in the true equator and equinox of date.
glm::dvec3 geocentricSun(double tt) {
    double heliocentric[2][3], barycentric[2][3];
    eraEpv00(modifiedJulianZero, tt, heliocentric, barycentric);
    const glm::dvec3 towards = -vector(heliocentric[0]);
    const double distance_au = glm::length(towards);
    const glm::dvec3 natural = towards / distance_au;
    const glm::dvec3 velocity = vector(barycentric[1]) * lightDaysPerAu;  // in parts of the speed of light
    double seen[3];
    double from[3] = {natural.x, natural.y, natural.z}, speed[3] = {velocity.x, velocity.y, velocity.z};
    eraAb(from, speed, distance_au, std::sqrt(1 - glm::dot(velocity, velocity)), seen);
    double rotation[3][3], ofDate[3];
    eraPnm06a(modifiedJulianZero, tt, rotation);
    eraRxp(rotation, seen, ofDate);
    return vector(ofDate) * distance_au;
}

/// The observer at sea level, in AU, turned with the Earth into the frame of geocentricSun.
glm::dvec3 observer(const SunPlace& place, double siderealTime_rad) {
    constexpr int wgs84 = 1;
    double position_m[3];
    eraGd2gc(wgs84, place.longitude_deg * radians, place.latitude_deg * radians, 0, position_m);
    const double c = std::cos(siderealTime_rad), s = std::sin(siderealTime_rad);
    return glm::dvec3(c * position_m[0] - s * position_m[1], s * position_m[0] + c * position_m[1],
                      position_m[2]) /
           metresPerAu;
}

/// T. Saemundsson, Atmospheric refraction, Sky and Telescope 72, 1986: 1010 hPa, 10 degrees C.
double refraction_deg(double altitude_deg) {
    constexpr double lowest_deg = -1;
    if (altitude_deg < lowest_deg) return 0;
    const double argument_deg = altitude_deg + 10.3 / (altitude_deg + 5.11);
    return 1.02 / 60 / std::tan(argument_deg * radians);
}

/// F. Kasten, A. T. Young, Revised optical air mass tables and approximation formula, Applied Optics 28,
/// 1989; by the altitude as it is seen.
double airMass(double altitude_deg) {
    const double altitude = std::max(altitude_deg, 0.0);
    return 1 / (std::sin(altitude * radians) + 0.50572 * std::pow(altitude + 6.07995, -1.6364));
}

}  // namespace

SunPosition sunPosition(const SunPlace& place) {
    const double tt = place.utc_days + ttMinusUtc_s / secondsPerDay;
    const double siderealTime_rad = eraGst06a(modifiedJulianZero, place.utc_days, modifiedJulianZero, tt);
    const glm::dvec3 sun = geocentricSun(tt) - observer(place, siderealTime_rad);

    const double rightAscension_rad = std::atan2(sun.y, sun.x);
    const double declination_rad = std::atan2(sun.z, std::hypot(sun.x, sun.y));
    double azimuth_rad = 0, altitude_rad = 0;
    eraHd2ae(siderealTime_rad + place.longitude_deg * radians - rightAscension_rad, declination_rad,
             place.latitude_deg * radians, &azimuth_rad, &altitude_rad);

    SunPosition position;
    const double distance_au = glm::length(sun);
    position.azimuth_deg = azimuth_rad / radians;
    position.altitude_deg = altitude_rad / radians;
    position.refracted_altitude_deg = position.altitude_deg + refraction_deg(position.altitude_deg);
    position.diameter_deg = 2 * std::asin(sunRadius_m / (distance_au * metresPerAu)) / radians;
    constexpr double solarIlluminance_lux = 127500, clearSky = 0.21;
    if (position.refracted_altitude_deg > -0.5 * position.diameter_deg)  // any of it is above the horizon
        position.illuminance_lux = solarIlluminance_lux / (distance_au * distance_au) *
                                   std::exp(-clearSky * airMass(position.refracted_altitude_deg));
    return position;
}

}  // namespace penumbra::studio
