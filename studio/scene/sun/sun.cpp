// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/sun/sun.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <numbers>

#include "studio/errors.h"
#include "studio/scene/lights/light_units.h"
#include "studio/scene/profiles/number_stream.h"

namespace penumbra::studio {
namespace {

constexpr double radians = std::numbers::pi / 180;

/// Reads a text from its left.
class TimeText {
  public:
    explicit TimeText(std::string_view text) : rest_(text) {}

    /// Exactly so many digits, as a number.
    bool digits(std::size_t count, int& value) {
        if (rest_.size() < count) return false;
        value = 0;
        for (const char c : rest_.substr(0, count)) {
            if (c < '0' || c > '9') return false;
            value = 10 * value + (c - '0');
        }
        rest_.remove_prefix(count);
        return true;
    }
    bool skip(char c) {
        if (!rest_.starts_with(c)) return false;
        rest_.remove_prefix(1);
        return true;
    }
    /// ".25" as 0.25; 0 where there is none.
    double fraction() {
        if (!skip('.')) return 0;
        double value = 0, digit = 0.1;
        for (; !rest_.empty() && rest_[0] >= '0' && rest_[0] <= '9'; rest_.remove_prefix(1), digit /= 10)
            value += digit * (rest_[0] - '0');
        return value;
    }
    bool ended() const { return rest_.empty(); }

  private:
    std::string_view rest_;
};

/// Minutes east of Greenwich: "Z", "+05:45", "-0500" or "+01".
bool parseZone(TimeText& text, int& zone_min) {
    zone_min = 0;
    if (text.skip('Z') || text.skip('z')) return true;
    const bool east = text.skip('+');
    if (!east && !text.skip('-')) return false;
    int hours = 0, minutes = 0;
    if (!text.digits(2, hours) || hours > 15) return false;
    const bool colon = text.skip(':');
    if (!(text.ended() && !colon) && (!text.digits(2, minutes) || minutes > 59)) return false;
    zone_min = (east ? 1 : -1) * (60 * hours + minutes);
    return true;
}

[[noreturn]] void failTime(std::string_view text, std::string_view problem, const std::string& where) {
    throw InputError(
        fmt::format("{}: the time '{}' {}, for instance 2026-06-21T13:00+01:00", where, text, problem));
}

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
    TimeText rest(text);
    int year = 0, month = 0, day = 0, hour = 0, minute = 0, whole_s = 0, zone_min = 0;
    const auto separator = [&] { return rest.skip('T') || rest.skip('t') || rest.skip(' '); };
    if (!(rest.digits(4, year) && rest.skip('-') && rest.digits(2, month) && rest.skip('-') &&
          rest.digits(2, day) && separator() && rest.digits(2, hour) && rest.skip(':') &&
          rest.digits(2, minute)))
        failTime(text, "is not YYYY-MM-DDTHH:MM and a zone", where);
    double second = 0;
    if (rest.skip(':')) {
        if (!rest.digits(2, whole_s)) failTime(text, "is not YYYY-MM-DDTHH:MM:SS and a zone", where);
        second = whole_s + rest.fraction();
    }
    if (rest.ended()) failTime(text, "has no zone: end it with Z or an offset from UTC", where);
    if (!parseZone(rest, zone_min) || !rest.ended())
        failTime(text, "does not end with a zone, Z or an offset from UTC", where);

    const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(unsigned(month)),
                                           std::chrono::day(unsigned(day))};
    if (!date.ok() || hour > 23 || minute > 59 || second >= 61)
        failTime(text, "is no moment of the calendar", where);
    constexpr int firstYear = 1900, lastYear = 2100;  // of the series of Earth's path
    if (year < firstYear || year > lastYear) failTime(text, "lies outside the years 1900 to 2100", where);
    constexpr double modifiedJulianOf1970 = 40587;
    const double days = modifiedJulianOf1970 + double(std::chrono::sys_days(date).time_since_epoch().count());
    return days + ((hour * 60 + minute - zone_min) * 60 + second) / 86400;
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
    return light;
}

}  // namespace penumbra::studio
