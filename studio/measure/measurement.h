// SPDX-License-Identifier: Apache-2.0
// Direct illuminance at points: what is measured, and what follows from it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "studio/frame/point_lighting.h"
#include "studio/measure/point_set.h"
#include "studio/measure/sun_day.h"
#include "studio/workbench/workbench.h"

namespace penumbra::studio {

struct MeasuredValue {
    float lux = 0;
    float bound_lux = 0;  ///< the technique's own: how far off `lux` may be
};

struct Measurement {
    PointSet set;
    /// One a point: the node in whose body it lies, or nothing. Those inside have no light, and count in no
    /// mean.
    std::vector<std::string> inside;
    std::vector<MeasuredValue> values;  ///< one a point, of all lights; of a day: its mean

    struct OfLight {
        std::string light;
        std::vector<float> lux;  ///< one a point
    };
    std::vector<OfLight> lights;  ///< where asked for

    /// Of a day, one a time.
    struct OfTime {
        SunMoment moment;
        std::vector<float> lux;  ///< one a point
    };
    std::vector<OfTime> times;
    std::vector<float> sunHours;  ///< of a day, one a point: of direct sun

    /// What measuring it again has cost, where that was asked for.
    struct Cost {
        std::vector<double> runs_ms;
        std::string clock;  ///< as CostClock names it
    };
    Cost cost;

    bool counts(std::size_t point) const { return inside[point].empty(); }
};

/// Over the points that count.
struct Summary {
    std::size_t points = 0;
    double min = 0, mean = 0, max = 0;
    double uniformity() const { return mean > 0 ? min / mean : 0; }
};
Summary summaryOf(const Measurement& measurement, const std::function<double(std::size_t)>& valueOf);
Summary luxSummary(const Measurement& measurement);

struct MeasuringOptions {
    bool perLight = false;
    /// The sun of the moment's last light at other times, in place of that light. Empty: not asked for.
    std::vector<SunMoment> day;
    std::function<void(double)> progress = {};  ///< the share that is done
};

/// All that is known before anything is measured: which points lie inside of what, and room for what comes.
/// Throws InputError where there is none.
Measurement prepare(const Scene& scene, const SceneMoment& moment, PointSet set,
                    const MeasuringOptions& options);

/// Measures all lights of the moment at the points that count, in blocks, so that the device's memory is
/// bounded. The scene is open on the workbench. A technique that weights the light's parts by their
/// irradiance gives lux that are right where a light is seen in part.
void measure(Measurement& measurement, Workbench& workbench, const SceneMoment& moment, Technique& technique,
             const MeasuringOptions& options);

/// The same of a scene that is at the moment already, with lighting of the same device that is kept.
void measure(Measurement& measurement, Device& device, PointLighting& lighting, const GpuScene& scene,
             const SceneMoment& moment, Technique& technique, const MeasuringOptions& options);

/// Measures what was `prepared` again, `runs` times, and returns what each run has cost: the device's work
/// and what is read from it, with the technique and its trees at hand.
Measurement::Cost timeRuns(const Measurement& prepared, Workbench& workbench, const SceneMoment& moment,
                           Technique& technique, const MeasuringOptions& options, int runs);

}  // namespace penumbra::studio
