// SPDX-License-Identifier: Apache-2.0
#include "studio/measure/sun_day.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "studio/errors.h"

namespace penumbra::studio {
namespace {

constexpr int minutesOfDay = 24 * 60;

[[noreturn]] void fail(std::string_view over) {
    throw InputError(fmt::format(
        "--over: '{}' is not HH:MM-HH:MM or HH:MM-HH:MM/STEPmin, for instance 08:00-18:00/15min", over));
}

/// Takes a number off the front.
bool takeNumber(std::string_view& text, int& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || value < 0) return false;
    text.remove_prefix(std::size_t(end - text.data()));
    return true;
}

bool take(std::string_view& text, std::string_view word) {
    if (!text.starts_with(word)) return false;
    text.remove_prefix(word.size());
    return true;
}

bool takeClock(std::string_view& text, int& minute) {
    int hours = 0, minutes = 0;
    if (!takeNumber(text, hours) || !take(text, ":") || !takeNumber(text, minutes)) return false;
    minute = 60 * std::min(hours, 24) + std::min(minutes, 60);
    return minutes < 60 && minute <= minutesOfDay;
}

struct Span {
    int first_min = 0, last_min = 0, step_min = 15;
};

Span parseSpan(std::string_view over) {
    Span span;
    std::string_view rest = over;
    if (!takeClock(rest, span.first_min) || !take(rest, "-") || !takeClock(rest, span.last_min)) fail(over);
    if (take(rest, "/")) {
        if (!takeNumber(rest, span.step_min)) fail(over);
        if (take(rest, "h"))
            span.step_min = std::min(span.step_min, 24) * 60;
        else if (!take(rest, "min"))
            fail(over);
    }
    if (!rest.empty()) fail(over);
    if (span.last_min <= span.first_min)
        throw InputError(fmt::format("--over: '{}' ends before it begins", over));
    if (span.step_min < 1 || span.step_min > minutesOfDay)
        throw InputError(fmt::format("--over: a step of '{}' lies between 1 minute and a day", over));
    // Midnight at its end is the next day's, of which the calendar would have to be asked.
    span.last_min = std::min(span.last_min, minutesOfDay - 1);
    return span;
}

/// "LAT,LON,DATE" and the zone, between which a clock fits.
struct DayText {
    std::string before, zone;
};

DayText dayOf(std::string_view place) {
    parseSunPlace(place, "--sun");  // which tells all that may be wrong with it
    const std::size_t time = place.find(',', place.find(',') + 1) + 1;
    const std::size_t clock = place.find_first_of("Tt ", place.find_first_not_of(' ', time)) + 1;
    const std::size_t zone = place.find_first_of("Zz+-", clock);
    return {std::string(place.substr(0, clock)), std::string(place.substr(zone))};
}

}  // namespace

std::vector<SunMoment> sunDay(std::string_view over, std::string_view place, const SunSetting& setting) {
    const Span span = parseSpan(over);
    const DayText day = dayOf(place);
    std::vector<SunMoment> moments;
    for (int minute = span.first_min; minute <= span.last_min; minute += span.step_min) {
        SunMoment& moment = moments.emplace_back();
        moment.clock = fmt::format("{:02}:{:02}", minute / 60, minute % 60);
        moment.hour = minute / 60.0;
        moment.place = day.before + moment.clock + day.zone;
        const SunPlace sun = parseSunPlace(moment.place, "--sun");
        moment.position = sunPosition(sun);
        if (isRisen(moment.position, setting)) moment.light = sunLight("sun", sun, setting, "--sun");
    }
    if (std::ranges::none_of(moments, [](const SunMoment& moment) { return moment.light.has_value(); })) {
        throw InputError(
            fmt::format("--over: the sun is below the horizon from {} to {} on this day at this "
                        "place: at the best {:.3f} degrees",
                        moments.front().clock, moments.back().clock,
                        std::ranges::max(moments, {}, [](const SunMoment& moment) {
                            return moment.position.altitude_deg;
                        }).position.altitude_deg));
    }
    return moments;
}

std::vector<double> hoursOf(const std::vector<SunMoment>& day) {
    std::vector<double> hours(day.size(), 0);
    for (std::size_t i = 1; i < day.size(); ++i) {
        const double half = 0.5 * (day[i].hour - day[i - 1].hour);
        hours[i - 1] += half;
        hours[i] += half;
    }
    return hours;
}

}  // namespace penumbra::studio
