// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/sun/sun.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <numbers>

#include "studio/errors.h"
#include "studio/scene/lights/light_units.h"
#include "studio/scene/profiles/number_stream.h"
#include "studio/scene/sun/sun_clock.h"

namespace penumbra::studio {
namespace {

constexpr double radians = std::numbers::pi / 180;

double seenAltitude_deg(const SunPosition& position, const SunSetting& setting) {
    return setting.refraction ? position.refracted_altitude_deg : position.altitude_deg;
}

}  // namespace

void requirePlace(double latitude_deg, double longitude_deg, const std::string& where) {
    if (!(std::abs(latitude_deg) <= 90))
        throw InputError(
            fmt::format("{}: a latitude lies between -90 and 90 degrees, not at {:g}", where, latitude_deg));
    if (!(std::abs(longitude_deg) <= 180))
        throw InputError(fmt::format("{}: a longitude lies between -180 and 180 degrees, not at {:g}", where,
                                     longitude_deg));
}

double parseSunTime(std::string_view text, const std::string& where) {
    return utcDaysOf(parseSunClock(text, where));
}

SunPlace parseSunPlace(std::string_view text, const std::string& where) {
    const std::size_t first = text.find(',');
    const std::size_t second = first == text.npos ? first : text.find(',', first + 1);
    SunPlace place;
    const auto read = [&](std::size_t begin, std::size_t end, double& value) {
        const auto number = parseNumber(trimmed(text.substr(begin, end - begin)), false);
        value = number.value_or(0);
        return number.has_value();
    };
    if (second == text.npos || !read(0, first, place.latitude_deg) ||
        !read(first + 1, second, place.longitude_deg))
        throw InputError(fmt::format(
            "{}: '{}' is not LATITUDE,LONGITUDE,TIME, for instance 52.52,13.405,2026-06-21T13:00+01:00",
            where, text));
    requirePlace(place.latitude_deg, place.longitude_deg, where);
    place.utc_days = parseSunTime(trimmed(text.substr(second + 1)), where);
    return place;
}

bool isRisen(const SunPosition& position, const SunSetting& setting) {
    return seenAltitude_deg(position, setting) > -0.5 * position.diameter_deg;
}

void requireRisen(const SunPlace& place, const SunSetting& setting, const std::string& where) {
    const SunPosition position = sunPosition(place);
    if (!isRisen(position, setting))
        throw InputError(fmt::format(
            "{}: the sun is below the horizon there and then: altitude {:.3f}, azimuth {:.3f} degrees", where,
            seenAltitude_deg(position, setting), position.azimuth_deg));
}

glm::dmat4 worldFromDistantLight(double azimuth_deg, double altitude_deg) {
    const double heading = azimuth_deg * radians, up = altitude_deg * radians;
    const glm::dvec3 towards(std::cos(up) * std::sin(heading), std::sin(up),
                             -std::cos(up) * std::cos(heading));
    const glm::dvec3 x(std::cos(heading), 0, std::sin(heading));
    const glm::dvec3 y = glm::cross(towards, x);
    return {glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(towards, 0), glm::dvec4(0, 0, 0, 1)};
}

Light sunLight(const std::string& name, const SunPlace& place, const SunSetting& setting,
               const std::string& where) {
    requireRisen(place, setting, where);
    const SunPosition position = sunPosition(place);
    const double altitude_deg = seenAltitude_deg(position, setting);
    Light light;
    light.name = name;
    light.shape.shape = LightShape::distant;
    light.shape.angle_rad = float(position.diameter_deg * radians);
    // -Z turned by north_deg is north, +X turned by it is east.
    light.shape.worldFromLight = std::bit_cast<Mat4>(
        glm::mat4(worldFromDistantLight(position.azimuth_deg + setting.north_deg, altitude_deg)));
    light.emission.value =
        glm::vec3(radianceFromIlluminance_nits(float(position.illuminance_lux), light.shape.angle_rad));
    light.sun = {.latitude_deg = place.latitude_deg,
                 .longitude_deg = place.longitude_deg,
                 .time = textOf(clockOf(place.utc_days)),
                 .setting = setting};
    return light;
}

Light sunLight(const std::string& name, const SunOrigin& origin, const std::string& where) {
    requirePlace(origin.latitude_deg, origin.longitude_deg, where);
    const SunPlace place{origin.latitude_deg, origin.longitude_deg, parseSunTime(origin.time, where)};
    Light light = sunLight(name, place, origin.setting, where);
    light.emission.value *= origin.multiplier;
    light.sun = origin;
    return light;
}

}  // namespace penumbra::studio
