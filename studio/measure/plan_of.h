// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "penumbra/penumbra.h"
#include "studio/measure/measurement.h"
#include "studio/measure/plan.h"

namespace penumbra::studio {

/// What is set where nothing else is asked for: lux are of irradiance, and points are few.
void setForMeasuring(Technique& technique);

/// Of a measurement with a grid: a value a cell, NaN where no point counts.
ValueGrid gridOf(const Measurement& measurement, const std::function<double(std::size_t)>& valueOf);
/// Hours of sun of a day, else lux.
ValueGrid gridOf(const Measurement& measurement);

/// The plan of a measurement with a grid. `place` is the day's, as --sun has it.
Plan planOf(const Measurement& measurement, const Scene& scene, const SceneMoment& moment,
            const std::string& sceneName, const std::string& place);

}  // namespace penumbra::studio
