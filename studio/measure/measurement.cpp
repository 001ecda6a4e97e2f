// SPDX-License-Identifier: Apache-2.0
#include "studio/measure/measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>

#include "penumbra/penumbra.h"
#include "studio/errors.h"
#include "studio/frame/point_lighting.h"
#include "studio/measure/closed_bodies.h"
#include "studio/measure/light_parts.h"
#include "studio/workbench/cost_clock.h"
#include "studio/workbench/parameter_list.h"

namespace penumbra::studio {
namespace {

/// So many points are on the device at a time.
constexpr std::size_t blockPoints = std::size_t(1) << 16;

/// Bits of x, y and z in turn: points whose numbers are near are near each other.
std::uint64_t interleaved(const glm::uvec3& place) {
    std::uint64_t code = 0;
    constexpr int bits = 20;
    for (int bit = bits; bit-- > 0;) {
        for (int axis = 0; axis < 3; ++axis) code = code << 1 | (place[axis] >> bit & 1u);
    }
    return code;
}

/// How far along a curve through a grid (Hilbert 1891) a cell lies: cells that follow each other on it,
/// however many, lie together.
std::uint64_t alongCurve(const MeasuringPoint& cell) {
    glm::uvec2 place(cell.column, cell.row);
    std::uint64_t along = 0;
    constexpr std::uint32_t side = std::uint32_t(mostPoints);
    for (std::uint32_t half = side / 2; half > 0; half /= 2) {
        const std::uint32_t right = (place.x & half) != 0 ? 1 : 0, up = (place.y & half) != 0 ? 1 : 0;
        along = 4 * along + ((3 * right) ^ up);
        // Each quarter holds the same curve, turned.
        place = {place.x & (half - 1), place.y & (half - 1)};
        if (up != 0) continue;
        if (right != 0) place = glm::uvec2(half - 1) - place;
        std::swap(place.x, place.y);
    }
    return along;
}

/// The points that count, those that lie near each other together.
std::vector<std::size_t> orderOf(const Measurement& measurement) {
    const std::vector<MeasuringPoint>& points = measurement.set.points;
    std::vector<std::size_t> order;
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!measurement.counts(i)) continue;
        order.push_back(i);
        low = glm::min(low, points[i].posWorld);
        high = glm::max(high, points[i].posWorld);
    }
    const glm::dvec3 size = glm::max(high - low, glm::dvec3(1e-9));
    const double largest = std::max({size.x, size.y, size.z});
    constexpr double steps = (1 << 20) - 1;
    std::vector<std::uint64_t> codes(points.size());
    for (const std::size_t i : order) {
        codes[i] = measurement.set.grid
                       ? alongCurve(points[i])
                       : interleaved(glm::uvec3(steps / largest * (points[i].posWorld - low)));
    }
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return codes[i]; });
    return order;
}

/// A number that a technique may have as a parameter, and that is another until this ends. Where it has none
/// nothing is set.
class LentParameter {
  public:
    LentParameter(Technique& technique, std::string_view name) : technique_(technique), name_(name) {
        for (const ParameterDescription& parameter : describeParameters(technique)) {
            if (parameter.name != name || parameter.kind != ParameterDescription::Kind::integer) continue;
            std::from_chars(parameter.value.data(), parameter.value.data() + parameter.value.size(), own_);
            most_ = int(parameter.max);
        }
        set_ = own_;
    }
    LentParameter(const LentParameter&) = delete;
    LentParameter& operator=(const LentParameter&) = delete;
    ~LentParameter() { set(own_); }

    /// As the technique came; 0 where it has no such parameter.
    int own() const { return own_; }
    int most() const { return most_; }
    void set(int value) {
        if (own_ == 0) return;
        if (value != set_) setParameter(technique_, name_, std::to_string(value));
        set_ = value;
    }

  private:
    Technique& technique_;
    std::string_view name_;
    int own_ = 0, most_ = 0, set_ = 0;
};

/// What all of a light sends to the points of a block.
class LightMeter {
  public:
    LightMeter(PointLighting& lighting, const GpuScene& scene, const PointSet& set, Technique& technique)
        : scene_(scene),
          set_(set),
          technique_(technique),
          lighting_(lighting),
          samples_(technique, "samples"),
          cells_(technique, "cells") {}

    std::vector<PointLight> measure(const Points& points, const Light& light) {
        const glm::ivec2 wanted = partsWanted(light, set_.points);
        const int cells = cellsFor(light, wanted);
        const std::vector<Light> parts = partsOf(light, (wanted + cells - 1) / cells);
        shareSamples(int(parts.size()));
        cells_.set(cells);
        std::vector<PointLight> sum(points.count());
        for (const Light& part : parts) {
            const std::vector<PointLight> added = lighting_.measure(points, scene_, part, technique_);
            for (std::size_t i = 0; i < sum.size(); ++i) {
                sum[i].lux += added[i].lux;
                sum[i].bound_lux += added[i].bound_lux;
                sum[i].unshadowed_lux += added[i].unshadowed_lux;
            }
        }
        for (PointLight& at : sum) at.seen = at.unshadowed_lux > 0 ? at.lux / at.unshadowed_lux : 0;
        return sum;
    }

  private:
    /// Along each side of the light, where the technique answers for cells of it at once. (None does for
    /// those of textured lights, and past panes.)
    int cellsFor(const Light& light, const glm::ivec2& wanted) const {
        if (light.texture >= 0 || needsColor(light.shape, scene_.casters())) return 1;
        constexpr double leastSamples = 4;  // of a cell, so that its bound holds
        const int most = std::min(cells_.most(), int(std::sqrt(double(samples_.own()) / leastSamples)));
        return std::clamp(std::max(wanted.x, wanted.y), 1, std::max(most, 1));
    }

    /// Parts of a light share its samples.
    void shareSamples(int parts) {
        constexpr int least = 64;  // of a part, or what was asked for where that is less
        samples_.set(parts == 1 ? samples_.own()
                                : std::max(samples_.own() / parts, std::min(samples_.own(), least)));
    }

    const GpuScene& scene_;
    const PointSet& set_;
    Technique& technique_;
    PointLighting& lighting_;
    LentParameter samples_, cells_;
};

Points pointsOf(Device& device, const PointSet& set, std::span<const std::size_t> which) {
    std::vector<Vec3> positions, normals;
    const auto plain = [](const glm::dvec3& v) { return Vec3{float(v.x), float(v.y), float(v.z)}; };
    for (const std::size_t i : which) {
        positions.push_back(plain(set.points[i].posWorld));
        normals.push_back(plain(set.points[i].normalWorld));
    }
    return Points(device, positions, normals);
}

/// The sun's disk counts as seen where half of it is.
constexpr float seenHalf = 0.5f;

/// The lights that stay as they are.
std::vector<Light> lightsOf(const SceneMoment& moment, const MeasuringOptions& options) {
    std::vector<Light> lights = moment.lights;
    if (!options.day.empty()) lights.pop_back();
    return lights;
}

/// The sun at each time, on top of what other lights have given.
void addDay(Measurement& measurement, const Points& points, std::span<const std::size_t> which,
            LightMeter& meter, const MeasuringOptions& options, const std::function<void()>& tell) {
    if (options.day.empty()) return;
    const std::vector<double> hours = hoursOf(options.day);
    const double allHours = std::accumulate(hours.begin(), hours.end(), 0.0);
    std::vector<MeasuredValue> mean(which.size());
    for (std::size_t time = 0; time < options.day.size(); ++time) {
        const std::optional<Light>& sun = options.day[time].light;
        const std::vector<PointLight> measured =
            sun ? meter.measure(points, *sun) : std::vector<PointLight>(which.size());
        const float share = float(hours[time] / allHours);
        for (std::size_t i = 0; i < which.size(); ++i) {
            measurement.times[time].lux[which[i]] = measurement.values[which[i]].lux + measured[i].lux;
            mean[i].lux += share * measured[i].lux;
            mean[i].bound_lux += share * measured[i].bound_lux;
            if (measured[i].seen >= seenHalf) measurement.sunHours[which[i]] += float(hours[time]);
        }
        tell();
    }
    for (std::size_t i = 0; i < which.size(); ++i) {
        measurement.values[which[i]].lux += mean[i].lux;
        measurement.values[which[i]].bound_lux += mean[i].bound_lux;
    }
}

}  // namespace

Summary summaryOf(const Measurement& measurement, const std::function<double(std::size_t)>& valueOf) {
    Summary summary;
    for (std::size_t i = 0; i < measurement.set.points.size(); ++i) {
        if (!measurement.counts(i)) continue;
        const double value = valueOf(i);
        summary.min = summary.points == 0 ? value : std::min(summary.min, value);
        summary.max = summary.points == 0 ? value : std::max(summary.max, value);
        summary.mean += value;
        ++summary.points;
    }
    if (summary.points > 0) summary.mean /= double(summary.points);
    return summary;
}

Summary luxSummary(const Measurement& measurement) {
    return summaryOf(measurement, [&](std::size_t i) { return double(measurement.values[i].lux); });
}

Measurement prepare(const Scene& scene, const SceneMoment& moment, PointSet set,
                    const MeasuringOptions& options) {
    Measurement result{.set = std::move(set)};
    const std::vector<MeasuringPoint>& points = result.set.points;
    const std::size_t columns = (options.perLight ? moment.lights.size() : 0) + options.day.size();
    constexpr std::size_t mostNumbers = std::size_t(1) << 27;
    if (columns * points.size() > mostNumbers) {
        throw InputError(
            fmt::format("{} points for each of {} lights and times are too many numbers: measure "
                        "them in several pieces (--rows)",
                        points.size(), columns));
    }
    const ClosedBodies bodies(scene, moment, points);
    for (const MeasuringPoint& point : points) {
        const std::string* body = bodies.around(point);
        result.inside.push_back(body == nullptr ? "" : *body);
    }
    result.values.resize(points.size());
    if (options.perLight) {
        for (const Light& light : lightsOf(moment, options))
            result.lights.push_back({light.name, std::vector<float>(points.size())});
    }
    for (const SunMoment& sun : options.day) result.times.push_back({sun, std::vector<float>(points.size())});
    if (!options.day.empty()) result.sunHours.resize(points.size());
    return result;
}

void measure(Measurement& measurement, Workbench& workbench, const SceneMoment& moment, Technique& technique,
             const MeasuringOptions& options) {
    workbench.scene().update(moment);
    PointLighting lighting(workbench.device());
    measure(measurement, workbench.device(), lighting, workbench.scene(), moment, technique, options);
}

void measure(Measurement& measurement, Device& device, PointLighting& lighting, const GpuScene& scene,
             const SceneMoment& moment, Technique& technique, const MeasuringOptions& options) {
    const std::vector<Light> lights = lightsOf(moment, options);
    LightMeter meter(lighting, scene, measurement.set, technique);
    const std::vector<std::size_t> order = orderOf(measurement);
    const std::size_t steps = std::max<std::size_t>(lights.size() + options.day.size(), 1);
    for (std::size_t first = 0; first < order.size(); first += blockPoints) {
        const std::span which = std::span(order).subspan(first, std::min(blockPoints, order.size() - first));
        const Points points = pointsOf(device, measurement.set, which);
        std::size_t step = 0;
        const auto tell = [&] {
            const double inBlock = double(++step) / double(steps);
            if (options.progress)
                options.progress((double(first) + inBlock * double(which.size())) / double(order.size()));
        };
        for (std::size_t light = 0; light < lights.size(); ++light) {
            const std::vector<PointLight> measured = meter.measure(points, lights[light]);
            for (std::size_t i = 0; i < which.size(); ++i) {
                measurement.values[which[i]].lux += measured[i].lux;
                measurement.values[which[i]].bound_lux += measured[i].bound_lux;
                if (options.perLight) measurement.lights[light].lux[which[i]] = measured[i].lux;
            }
            tell();
        }
        addDay(measurement, points, which, meter, options, tell);
    }
}

Measurement::Cost timeRuns(const Measurement& prepared, Workbench& workbench, const SceneMoment& moment,
                           Technique& technique, const MeasuringOptions& options, int runs) {
    workbench.scene().update(moment);
    PointLighting lighting(workbench.device());
    const CostClock clock(workbench.device());
    const auto measureInto = [&](Measurement& again) {
        measure(again, workbench.device(), lighting, workbench.scene(), moment, technique, options);
    };
    Measurement::Cost cost{.runs_ms = {}, .clock = std::string(clock.name())};
    // Other points in between, so that a technique has no answer left of the last run.
    Measurement other = prepared;
    other.set.points.resize(std::min<std::size_t>(other.set.points.size(), 1));
    for (int run = 0; run < runs; ++run) {
        Measurement again = other;
        measureInto(again);
        again = prepared;
        cost.runs_ms.push_back(clock.milliseconds([&] { measureInto(again); }));
    }
    return cost;
}

}  // namespace penumbra::studio
