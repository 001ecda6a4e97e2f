// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>

#include "studio/errors.h"
#include "studio/scene/sun/sun.h"
#include "studio/scene/sun/sun_clock.h"
#include "studio/viewer/panels/panels.h"

namespace penumbra::studio::viewer {
namespace {

/// Berlin at noon on the longest day.
SunOrigin firstSun() {
    return {.latitude_deg = 52.52, .longitude_deg = 13.405, .time = "2026-06-21T13:00+02:00"};
}

bool editNumber(Ui& ui, const char* label, double& value, float limit) {
    auto shown = float(value);
    if (!ui.slider(label, shown, -limit, limit, "%.2f")) return false;
    value = shown;
    return true;
}

bool editTime(Ui& ui, std::string& time) {
    SunClock clock = parseSunClock(time, "the sun");
    bool changed = false;
    int day = dayOfYear(clock);
    if (ui.slider("day of the year", day, 1, 366)) {
        setDayOfYear(clock, day);
        changed = true;
    }
    constexpr int minutesOfDay = 24 * 60;
    float hour = float(clock.hour) + (float(clock.minute) + float(clock.second) / 60) / 60;
    if (ui.slider("hour", hour, 0, 24, "%.2f")) {
        const int minute = std::clamp(int(std::lround(60 * hour)), 0, minutesOfDay - 1);
        clock.hour = minute / 60;
        clock.minute = minute % 60;
        clock.second = 0;
        changed = true;
    }
    constexpr int quarters = 4, quarter_min = 15;
    float zone_h = float(clock.zone_min) / 60;
    if (ui.slider("zone (h from UTC)", zone_h, -12, 14, "%.2f")) {
        clock.zone_min = quarter_min * int(std::lround(quarters * zone_h));
        changed = true;
    }
    changed |= ui.slider("year", clock.year, 1900, 2100);
    if (changed) {
        setDayOfYear(clock, dayOfYear(clock));  // the 29th of February may be none of another year's
        time = textOf(clock);
    }
    return changed;
}

}  // namespace

bool editSun(Ui& ui, Light& light, Requests& requests) {
    std::optional<SunOrigin> sun = light.sun;
    bool isSun = sun.has_value();
    bool changed = ui.checkbox("the sun of a place and time", isSun);
    if (changed) sun = isSun ? std::optional(firstSun()) : std::nullopt;
    if (sun) {
        ui.note(sun->time);
        changed |= editNumber(ui, "latitude (deg)", sun->latitude_deg, 90);
        changed |= editNumber(ui, "longitude (deg)", sun->longitude_deg, 180);
        changed |= editTime(ui, sun->time);
        changed |= editNumber(ui, "north (deg from -Z)", sun->setting.north_deg, 180);
        changed |= ui.checkbox("air bends its light", sun->setting.refraction);
        float much = std::max({sun->multiplier.r, sun->multiplier.g, sun->multiplier.b});
        if (ui.drag("times its light", much, 0.01f, 0, 1e6f)) {
            sun->multiplier = glm::vec3(much);
            changed = true;
        }
    }
    if (!changed) return false;
    if (!sun) {
        light.sun.reset();
        return true;
    }
    try {
        Light made = sunLight(light.name, *sun, "the sun");
        made.castsShadow = light.castsShadow;
        light = std::move(made);
        return true;
    } catch (const InputError& error) {
        requests.problem = error.what();  // at night it stays where it was
        return false;
    }
}

}  // namespace penumbra::studio::viewer
