// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <vector>

#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "studio/metrics/visibility_metrics.h"

namespace penumbra::studio::python {
namespace {

namespace py = pybind11;

/// As `compare --json` names them.
py::dict compare(const py::object& truth, const py::object& test, const py::object& reach) {
    std::vector<std::uint8_t> mask;
    if (!reach.is_none()) {
        for (const float reached : toImage(reach, "reach").values) mask.push_back(reached > 0);
    }
    const VisibilityMetrics metrics = compareVisibility(toImage(truth, "truth"), toImage(test, "test"), mask);
    py::dict dict;
    dict["rmse"] = metrics.rmse;
    dict["mae"] = metrics.mae;
    dict["penumbra_rmse"] = metrics.penumbra_rmse;
    dict["p99"] = metrics.p99;
    dict["max"] = metrics.max;
    dict["leak"] = metrics.leak;
    dict["false_shadow"] = metrics.false_shadow;
    dict["samples"] = metrics.samples;
    dict["not_finite"] = metrics.notFinite;
    return dict;
}

}  // namespace

void addJudging(py::module_& module) {
    module.def("compare", &compare, py::arg("truth"), py::arg("test"), py::arg("reach") = py::none(),
               R"(How far a visibility is from the truth, in units of visibility: dict of float.

truth, test: (height, width) or (height, width, 3), of one size; a test of one channel is compared with each of three.
reach: (height, width), of Frame.reach: only where it is above 0 is looked at.

rmse, mae, max, p99 (99 of 100 values err by no more); penumbra_rmse: rmse where 0.01 < truth < 0.99; leak: share of umbra
(truth <= 0.002) that got more than 0.1; false_shadow: share of the lit (truth >= 0.998) that lost more than 0.1. samples: values
compared; not_finite: values that are NaN or infinite, and make all the others NaN.

Raises InputError where sizes do not fit.)");
}

}  // namespace penumbra::studio::python
