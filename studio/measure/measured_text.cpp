// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <ostream>

#include "studio/json_text.h"
#include "studio/measure/measured_files.h"
#include "studio/measure/measured_places.h"

namespace penumbra::studio {
namespace {

std::string quoted(const std::string& text) {
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string numberOrNull(double value, bool counts) {
    return counts ? fmt::format("{:.7g}", value) : "null";
}

std::string vectorText(const glm::dvec3& v) {
    return fmt::format("[{:.12g}, {:.12g}, {:.12g}]", v.x, v.y, v.z);
}

void printPoint(std::ostream& out, const Measurement& measurement, std::size_t i, const StatedPlace& place) {
    const bool counts = measurement.counts(i);
    fmt::print(out, R"({{"position": {}, "normal": {}, "lux": {}, "bound": {})", vectorText(place.position),
               vectorText(place.normal), numberOrNull(measurement.values[i].lux, counts),
               numberOrNull(measurement.values[i].bound_lux, counts));
    if (!counts) fmt::print(out, R"(, "inside": {})", quoted(measurement.inside[i]));
    if (!measurement.lights.empty()) {
        out << R"(, "lights": {)";
        for (const Measurement::OfLight& light : measurement.lights) {
            fmt::print(out, "{}{}: {}", &light == &measurement.lights.front() ? "" : ", ",
                       quoted(light.light), numberOrNull(light.lux[i], counts));
        }
        out << "}";
    }
    if (!measurement.times.empty()) {
        fmt::print(out, R"(, "sun_hours": {}, "lux_at": [)", numberOrNull(measurement.sunHours[i], counts));
        for (const Measurement::OfTime& time : measurement.times) {
            fmt::print(out, "{}{}", &time == &measurement.times.front() ? "" : ", ",
                       numberOrNull(time.lux[i], counts));
        }
        out << "]";
    }
    out << "}";
}

std::map<std::string, std::size_t> bodiesOf(const Measurement& measurement) {
    std::map<std::string, std::size_t> bodies;
    for (const std::string& body : measurement.inside) {
        if (!body.empty()) ++bodies[body];
    }
    return bodies;
}

/// The middle one, the least and the largest.
std::array<double, 3> spreadOf(std::vector<double> runs_ms) {
    std::ranges::sort(runs_ms);
    return {runs_ms[runs_ms.size() / 2], runs_ms.front(), runs_ms.back()};
}

/// EN 17037:2018, 5.3: hours of sunlight exposure on the chosen day.
constexpr double leastSun_h = 1.5;

double shareInSun(const Measurement& measurement) {
    return summaryOf(measurement,
                     [&](std::size_t i) { return measurement.sunHours[i] >= float(leastSun_h) ? 1.0 : 0.0; })
        .mean;
}

}  // namespace

void printJson(std::ostream& out, const Measurement& measurement, const Scene& scene,
               const MeasuringHeading& heading) {
    const StatedPlaces places(scene);
    fmt::print(out, "{{\n \"format\": {},\n \"scene\": {},\n \"technique\": {},\n", jsonFormat,
               quoted(heading.scene), quoted(heading.technique));
    const Summary lux = luxSummary(measurement);
    const bool any = lux.points > 0;
    fmt::print(out, " \"min\": {},\n \"mean\": {},\n \"max\": {},\n \"uniformity\": {},\n",
               numberOrNull(lux.min, any), numberOrNull(lux.mean, any), numberOrNull(lux.max, any),
               numberOrNull(lux.uniformity(), any));
    out << " \"inside\": {";
    bool isFirst = true;
    for (const auto& [body, count] : bodiesOf(measurement)) {
        fmt::print(out, "{}{}: {}", isFirst ? "" : ", ", quoted(body), count);
        isFirst = false;
    }
    out << "},\n";
    if (!measurement.times.empty()) {
        fmt::print(out, " \"sunlight\": {{\"least_hours\": {:g}, \"share\": {}}},\n \"times\": [", leastSun_h,
                   numberOrNull(shareInSun(measurement), any));
        for (const Measurement::OfTime& time : measurement.times) {
            const Summary at = summaryOf(measurement, [&](std::size_t i) { return double(time.lux[i]); });
            fmt::print(out,
                       "{}\n  {{\"time\": {}, \"sun\": {{\"altitude_deg\": {:.4f}, \"azimuth_deg\": {:.4f}, "
                       "\"is_up\": {}}}, \"min\": {}, \"mean\": {}, \"max\": {}}}",
                       &time == &measurement.times.front() ? "" : ",", quoted(time.moment.clock),
                       time.moment.position.altitude_deg, time.moment.position.azimuth_deg,
                       time.moment.light.has_value(), numberOrNull(at.min, any), numberOrNull(at.mean, any),
                       numberOrNull(at.max, any));
        }
        out << "\n ],\n";
    }
    if (!measurement.cost.runs_ms.empty()) {
        const auto [median, min, max] = spreadOf(measurement.cost.runs_ms);
        fmt::print(out,
                   " \"ms\": {{\"median\": {:.3f}, \"min\": {:.3f}, \"max\": {:.3f}}},\n \"clock\": {},\n",
                   median, min, max, quoted(measurement.cost.clock));
    }
    out << " \"points\": [";
    for (std::size_t i = 0; i < measurement.set.points.size(); ++i) {
        out << (i == 0 ? "\n  " : ",\n  ");
        printPoint(out, measurement, i, places.of(measurement.set.points[i]));
    }
    out << "\n ]\n}\n";
}

void printTable(std::ostream& out, const Measurement& measurement, const Scene& scene) {
    constexpr std::size_t mostRows = 1000;
    const StatedPlaces places(scene);
    const std::size_t count = measurement.set.points.size();
    const bool isDay = !measurement.times.empty();
    if (count <= mostRows) {
        fmt::print(out, "{:>10} {:>10} {:>10} {:>11} {:>9}{}\n", "x", "y", "z", isDay ? "mean lx" : "lx",
                   "within", isDay ? "   sun h" : "");
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec3 p = places.of(measurement.set.points[i]).position;
            fmt::print(out, "{:10.3f} {:10.3f} {:10.3f} ", p.x, p.y, p.z);
            if (!measurement.counts(i)) {
                fmt::print(out, "inside '{}'\n", measurement.inside[i]);
                continue;
            }
            fmt::print(out, "{:11.2f} {:9.2f}", measurement.values[i].lux, measurement.values[i].bound_lux);
            if (isDay) fmt::print(out, " {:7.2f}", measurement.sunHours[i]);
            out << "\n";
        }
    } else {
        fmt::print(out, "{} points; --csv or --json has each of them\n", count);
    }
    for (const Measurement::OfTime& time : measurement.times) {
        const Summary at = summaryOf(measurement, [&](std::size_t i) { return double(time.lux[i]); });
        fmt::print(out, "{}  sun at {:6.2f} degrees   min {:.4g} lx, mean {:.4g} lx, max {:.4g} lx\n",
                   time.moment.clock, time.moment.position.altitude_deg, at.min, at.mean, at.max);
    }
    for (const Measurement::OfLight& light : measurement.lights) {
        const Summary of = summaryOf(measurement, [&](std::size_t i) { return double(light.lux[i]); });
        fmt::print(out, "{}: min {:.4g} lx, mean {:.4g} lx, max {:.4g} lx\n", light.light, of.min, of.mean,
                   of.max);
    }
    out << summaryText(measurement) << "\n";
    if (isDay) out << sunText(measurement) << "\n";
    for (const auto& [body, points] : bodiesOf(measurement))
        fmt::print(out, "{} points lie inside '{}' and are left out\n", points, body);
    if (!measurement.cost.runs_ms.empty()) {
        const auto [median, min, max] = spreadOf(measurement.cost.runs_ms);
        fmt::print(out, "cost: {:.1f} ms ({:.1f} to {:.1f}), {}\n", median, min, max, measurement.cost.clock);
    }
    if (measurement.set.cellsBeside > 0)
        fmt::print(out, "{} cells have nothing of the surface in their middle\n",
                   measurement.set.cellsBeside);
}

std::string summaryText(const Measurement& measurement) {
    const Summary lux = luxSummary(measurement);
    if (lux.points == 0) return "no point counts: all lie inside of bodies";
    const Summary bound =
        summaryOf(measurement, [&](std::size_t i) { return double(measurement.values[i].bound_lux); });
    return fmt::format(
        "min {:.4g} lx, mean {:.4g} lx, max {:.4g} lx, uniformity {:.3f}; {} points, within {:.3g} lx",
        lux.min, lux.mean, lux.max, lux.uniformity(), lux.points, bound.max);
}

std::string sunText(const Measurement& measurement) {
    const Summary hours =
        summaryOf(measurement, [&](std::size_t i) { return double(measurement.sunHours[i]); });
    return fmt::format(
        "direct sun: min {:.2f} h, mean {:.2f} h, max {:.2f} h; at least {:g} h (EN 17037) at {:.1f} % of "
        "the points",
        hours.min, hours.mean, hours.max, leastSun_h, 100 * shareInSun(measurement));
}

}  // namespace penumbra::studio
