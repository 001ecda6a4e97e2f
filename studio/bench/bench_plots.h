// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "studio/bench/bench_report.h"
#include "studio/report/plot.h"

namespace penumbra::studio {

/// Cost against the axis, a series for each technique.
Plot plotOf(const AxisResult& axis);

/// Error against cost: a series for each technique, its qualities joined, and the front.
Plot plotOfQuality(const BenchReport& report);

}  // namespace penumbra::studio
