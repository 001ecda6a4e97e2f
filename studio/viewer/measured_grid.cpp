// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/measured_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studio/errors.h"
#include "studio/image/atomic_file.h"
#include "studio/measure/measured_files.h"
#include "studio/measure/plan_of.h"
#include "studio/workbench/any_technique.h"
#include "studio/workbench/parameter_list.h"

namespace penumbra::studio::viewer {
namespace {

constexpr std::string_view samplesInMotion = "64", samplesAtRest = "1024";

/// Depths that a grid was placed by are floats: a little off the surface it does not shade itself.
double liftOf(const Document& document) {
    constexpr double share = 2e-4;
    return share * std::max(double(document.bounds().radius()), 1.0);
}

std::size_t sunAmong(const std::vector<Light>& lights) {
    return std::size_t(
        std::ranges::find_if(lights, [](const Light& light) { return light.sun.has_value(); }) -
        lights.begin());
}

/// The day, of the sun of the moment, which becomes its last light.
std::vector<SunMoment> dayOf(SceneMoment& moment, const std::string& over) {
    const std::size_t index = sunAmong(moment.lights);
    if (index == moment.lights.size())
        throw InputError("hours of sun need a sun: make a distant light the sun of a place and time");
    std::rotate(moment.lights.begin() + std::ptrdiff_t(index),
                moment.lights.begin() + std::ptrdiff_t(index) + 1, moment.lights.end());
    const Light sun = moment.lights.back();
    return sunDay(over, *MeasuredGrid::sunOf({sun}), sun.sun->setting);
}

PointSet pointsOf(const GridSpec& spec, const Document& document) {
    const glm::dvec3 up = (spec.above_m + liftOf(document)) * spec.normalWorld;
    return rectangleGrid(spec.fromWorld + up, spec.toWorld + up, spec.normalWorld, spec.columns, spec.rows,
                         document.scene());
}

bool haveSamePlaces(const GridSpec& a, const GridSpec& b) {
    return a.fromWorld == b.fromWorld && a.toWorld == b.toWorld && a.normalWorld == b.normalWorld &&
           a.above_m == b.above_m && a.columns == b.columns && a.rows == b.rows;
}

/// As prepared, with nothing measured: what lies inside of what is found once for a place of the grid.
Measurement emptied(const Measurement& before) {
    return {.set = before.set,
            .inside = before.inside,
            .values = std::vector<MeasuredValue>(before.set.points.size()),
            .lights = {},
            .times = {},
            .sunHours = {}};
}

}  // namespace

std::optional<std::string> MeasuredGrid::sunOf(const std::vector<Light>& lights) {
    const std::size_t index = sunAmong(lights);
    if (index == lights.size()) return {};
    const SunOrigin& sun = *lights[index].sun;
    return fmt::format("{},{},{}", sun.latitude_deg, sun.longitude_deg, sun.time);
}

bool MeasuredGrid::update(const Document& document, const std::optional<GridSpec>& spec, bool isMoving) {
    if (!spec) {
        const bool was = measurement_.has_value();
        measurement_.reset();
        made_.reset();
        problem_.clear();
        return was;
    }
    if (isMoving && spec->ofSunHours) return false;
    const bool isSame = made_ && made_->spec == *spec && made_->lights == document.lights().state() &&
                        made_->time_s == document.time_s();
    if (isSame && (isMoving || !made_->isRough)) return false;
    problem_.clear();
    try {
        measure(document, *spec, isMoving);
    } catch (const std::exception& error) {
        problem_ = error.what();
        measurement_.reset();
    }
    made_ = Made{*spec, document.lights().state(), document.time_s(), isMoving};
    return true;
}

void MeasuredGrid::measure(const Document& document, const GridSpec& spec, bool isMoving) {
    SceneMoment moment = document.moment();
    MeasuringOptions options;
    if (spec.ofSunHours) options.day = dayOf(moment, spec.over);
    const bool keepsPlaces = isMoving && measurement_ && made_ && haveSamePlaces(made_->spec, spec);
    Measurement measured = keepsPlaces ? emptied(*measurement_)
                                       : prepare(document.scene(), moment, pointsOf(spec, document), options);
    if (!technique_) {
        technique_ = makeAnyTechnique(device_, "exact");
        setForMeasuring(*technique_);
        lighting_ = std::make_unique<PointLighting>(device_);
    }
    setParameter(*technique_, "samples", isMoving ? samplesInMotion : samplesAtRest);
    studio::measure(measured, device_, *lighting_, document.gpuScene(), moment, *technique_, options);
    measurement_ = std::move(measured);
}

void MeasuredGrid::save(const Document& document, const std::filesystem::path& file) const {
    if (!measurement_) throw UsageError("there is no grid to save: place one under Measure");
    if (file.extension() == ".csv") return writeFileAtomically(file, toCsv(*measurement_, document.scene()));
    if (file.extension() != ".svg" && file.extension() != ".png")
        throw UsageError(fmt::format("'{}': a grid is saved as .csv, .svg or .png", file.string()));
    writePlan(file,
              planOf(*measurement_, document.scene(), document.moment(), document.nameOrPath(),
                     sunOf(document.moment().lights).value_or("")),
              {{"Software", "penumbra viewer"}});
}

void fitCells(GridSpec& spec) {
    constexpr double along = 20;
    const glm::dvec3 diagonal = spec.toWorld - spec.fromWorld;
    // As the grid's axes lie on floors and walls; elsewhere cells are as many either way.
    const bool isFloor = std::abs(spec.normalWorld.y) > 0.7;
    const double height = isFloor ? std::abs(diagonal.z) : std::abs(diagonal.y);
    const double width = isFloor ? std::abs(diagonal.x) : std::hypot(diagonal.x, diagonal.z);
    const double cell = std::max({width, height, 1e-6}) / along;
    spec.columns = std::max(int(std::lround(width / cell)), 1);
    spec.rows = std::max(int(std::lround(height / cell)), 1);
}

}  // namespace penumbra::studio::viewer
