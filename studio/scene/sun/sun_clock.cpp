// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/sun/sun_clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>

#include "studio/errors.h"

namespace penumbra::studio {
namespace {

namespace chrono = std::chrono;

constexpr double modifiedJulianOf1970 = 40587;

chrono::year_month_day dateOf(const SunClock& clock) {
    return {chrono::year(clock.year), chrono::month(unsigned(clock.month)), chrono::day(unsigned(clock.day))};
}

void setDate(SunClock& clock, const chrono::sys_days& days) {
    const chrono::year_month_day date(days);
    clock.year = int(date.year());
    clock.month = int(unsigned(date.month()));
    clock.day = int(unsigned(date.day()));
}

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

}  // namespace

SunClock parseSunClock(std::string_view text, const std::string& where) {
    TimeText rest(text);
    SunClock clock;
    int whole_s = 0;
    const auto separator = [&] { return rest.skip('T') || rest.skip('t') || rest.skip(' '); };
    if (!(rest.digits(4, clock.year) && rest.skip('-') && rest.digits(2, clock.month) && rest.skip('-') &&
          rest.digits(2, clock.day) && separator() && rest.digits(2, clock.hour) && rest.skip(':') &&
          rest.digits(2, clock.minute)))
        failTime(text, "is not YYYY-MM-DDTHH:MM and a zone", where);
    if (rest.skip(':')) {
        if (!rest.digits(2, whole_s)) failTime(text, "is not YYYY-MM-DDTHH:MM:SS and a zone", where);
        clock.second = whole_s + rest.fraction();
    }
    if (rest.ended()) failTime(text, "has no zone: end it with Z or an offset from UTC", where);
    if (!parseZone(rest, clock.zone_min) || !rest.ended())
        failTime(text, "does not end with a zone, Z or an offset from UTC", where);

    if (!dateOf(clock).ok() || clock.hour > 23 || clock.minute > 59 || clock.second >= 61)
        failTime(text, "is no moment of the calendar", where);
    constexpr int firstYear = 1900, lastYear = 2100;  // of the series of Earth's path
    if (clock.year < firstYear || clock.year > lastYear)
        failTime(text, "lies outside the years 1900 to 2100", where);
    return clock;
}

std::string textOf(const SunClock& clock) {
    const int second = std::min(int(std::lround(clock.second)), 59);
    std::string text = fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}", clock.year, clock.month, clock.day,
                                   clock.hour, clock.minute);
    if (second > 0) text += fmt::format(":{:02}", second);
    if (clock.zone_min == 0) return text + "Z";
    const int ahead_min = std::abs(clock.zone_min);
    return text +
           fmt::format("{}{:02}:{:02}", clock.zone_min < 0 ? '-' : '+', ahead_min / 60, ahead_min % 60);
}

double utcDaysOf(const SunClock& clock) {
    const double days =
        modifiedJulianOf1970 + double(chrono::sys_days(dateOf(clock)).time_since_epoch().count());
    return days + ((clock.hour * 60 + clock.minute - clock.zone_min) * 60 + clock.second) / 86400;
}

SunClock clockOf(double utc_days) {
    const auto seconds = chrono::seconds(std::llround((utc_days - modifiedJulianOf1970) * 86400));
    const chrono::sys_days days(chrono::floor<chrono::days>(seconds));
    const auto ofDay = (seconds - days.time_since_epoch()).count();
    SunClock clock{.hour = int(ofDay / 3600), .minute = int(ofDay / 60 % 60), .second = double(ofDay % 60)};
    setDate(clock, days);
    return clock;
}

int dayOfYear(const SunClock& clock) {
    const chrono::sys_days first(chrono::year(clock.year) / chrono::January / 1);
    return int((chrono::sys_days(dateOf(clock)) - first).count()) + 1;
}

void setDayOfYear(SunClock& clock, int day) {
    const chrono::sys_days first(chrono::year(clock.year) / chrono::January / 1);
    const chrono::sys_days last(chrono::year(clock.year) / chrono::December / 31);
    setDate(clock, std::min(first + chrono::days(day - 1), last));
}

}  // namespace penumbra::studio
