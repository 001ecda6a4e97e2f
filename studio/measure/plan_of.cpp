// SPDX-License-Identifier: Apache-2.0
#include "studio/measure/plan_of.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "studio/measure/measured_files.h"
#include "studio/workbench/parameter_list.h"

namespace penumbra::studio {

void setForMeasuring(Technique& technique) {
    constexpr double samples = 1024;
    for (const ParameterDescription& parameter : describeParameters(technique)) {
        if (parameter.name == "weight" && std::ranges::count(parameter.choices, "irradiance") > 0)
            setParameter(technique, parameter.name, "irradiance");
        if (parameter.name == "samples" && parameter.min <= samples && samples <= parameter.max)
            setParameter(technique, parameter.name, fmt::format("{}", samples));
    }
}

ValueGrid gridOf(const Measurement& measurement, const std::function<double(std::size_t)>& valueOf) {
    const GridFrame& frame = *measurement.set.grid;
    ValueGrid grid{.columns = frame.columns, .rows = frame.rows, .values = {}};
    grid.values.resize(std::size_t(frame.columns) * std::size_t(frame.rows),
                       std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < measurement.set.points.size(); ++i) {
        const MeasuringPoint& point = measurement.set.points[i];
        if (!measurement.counts(i)) continue;
        grid.values[std::size_t(point.row) * std::size_t(frame.columns) + std::size_t(point.column)] =
            valueOf(i);
    }
    return grid;
}

ValueGrid gridOf(const Measurement& measurement) {
    const bool isDay = !measurement.times.empty();
    return gridOf(measurement, [&](std::size_t i) {
        return double(isDay ? measurement.sunHours[i] : measurement.values[i].lux);
    });
}

Plan planOf(const Measurement& measurement, const Scene& scene, const SceneMoment& moment,
            const std::string& sceneName, const std::string& place) {
    const bool isDay = !measurement.times.empty();
    const GridFrame& frame = *measurement.set.grid;
    // What goes up on paper: right is across, and one looks against the normal.
    const glm::dvec3 up = glm::cross(frame.normalWorld, frame.acrossWorld);
    constexpr double margin = 0.1;
    Plan plan{.frame = frame,
              .values = gridOf(measurement),
              .unit = isDay ? "h" : "lx",
              .title = fmt::format("{}, {}", std::filesystem::path(sceneName).filename().string(),
                                   isDay ? "hours of direct sun" : "direct illuminance"),
              .notes = {summaryText(measurement)},
              .lines = planLinesOf(scene, moment, frame, margin * std::max(frame.width_m, frame.depth_m)),
              .isAlongDown = glm::dot(up, frame.alongWorld) < 0};
    if (isDay) {
        plan.notes = {sunText(measurement),
                      fmt::format("{} to {}, {}", measurement.times.front().moment.clock,
                                  measurement.times.back().moment.clock, place)};
    }
    return plan;
}

}  // namespace penumbra::studio
