// SPDX-License-Identifier: Apache-2.0
#include "apps/python/frame.h"

#include <pybind11/stl.h>

#include "apps/python/arrays.h"
#include "apps/python/bindings.h"

namespace penumbra::studio::python {
namespace {

namespace py = pybind11;

/// As `render --json` has it.
py::dict dictOf(const Statistics& statistics) {
    py::dict counts, passes_ms, dict;
    for (const Statistic& count : statistics.counts) counts[py::str(count.name)] = count.value;
    for (const PassTime& pass : statistics.passes) passes_ms[py::str(pass.name)] = pass.milliseconds;
    dict["counts"] = counts;
    dict["passes_ms"] = passes_ms;
    if (const auto& [technique, parameter, value] = statistics.chosen; !technique.empty()) {
        py::dict chosen;
        chosen["technique"] = technique;
        if (!parameter.empty()) chosen[py::str(parameter)] = value;
        dict["chosen"] = chosen;
    }
    return dict;
}

}  // namespace

Frame::Frame(Rendered&& rendered)
    : technique(rendered.result.technique),
      exposure_ev(rendered.result.exposureValue),
      depth(toArray(std::move(rendered.surfaces.depth_m))),
      normals(toArray(std::move(rendered.surfaces.normals))),
      illuminance(toArray(std::move(rendered.illuminance))),
      radiance(toArray(std::move(rendered.result.radiance))),
      display(toArray(std::move(rendered.result.display))) {
    for (LightResult& light : rendered.result.lights) {
        const py::str name(light.light);
        lights.push_back(light.light);
        visibility[name] = toArray(std::move(light.visibility));
        reach[name] = toArray(std::move(light.reach));
        statistics[name] = dictOf(light.statistics);
        milliseconds[name] = py::cast(light.milliseconds);
    }
}

void addFrame(py::module_& module) {
    py::class_<Frame>(
        module, "Frame",
        R"(What a render gives. Arrays are float32, rows from the top, and live on by themselves.

Pixels without a surface have depth inf, normal 0 and visibility 1.)")
        .def_readonly("technique", &Frame::technique, "Its name.")
        .def_readonly("lights", &Frame::lights, "Names, in the scene's order: list of str.")
        .def_readonly("exposure_ev", &Frame::exposure_ev, "That display is shown with: EV at ISO 100.")
        .def_readonly("visibility", &Frame::visibility,
                      "Dict of light to (height, width), or (height, width, 3) for a textured light: the "
                      "fraction of the "
                      "light that is seen, 0 to 1.")
        .def_readonly("reach", &Frame::reach,
                      "Dict of light to (height, width): its unshadowed irradiance for unit emission; 0 "
                      "where it does not "
                      "reach the surface. Errors are judged where it does.")
        .def_readonly("statistics", &Frame::statistics,
                      "Dict of light to {\"counts\": {name: float}, \"passes_ms\": {name: float}} and, where "
                      "a technique "
                      "takes another, \"chosen\": {\"technique\": name, parameter: value}.")
        .def_readonly("milliseconds", &Frame::milliseconds,
                      "Dict of light to list of float: the cost of each of timed_runs, on Renderer.clock.")
        .def_readonly("depth", &Frame::depth,
                      "(height, width), metres from the camera along the direction in which it looks.")
        .def_readonly("normals", &Frame::normals,
                      "(height, width, 3), world space, unit, of the triangles, on the side that is seen.")
        .def_readonly("illuminance", &Frame::illuminance,
                      "(height, width), lux of all lights, shadows included.")
        .def_readonly("radiance", &Frame::radiance, "(height, width, 3), nits, linear Rec. 709.")
        .def_readonly("display", &Frame::display,
                      "(height, width, 3), 0 to 1, sRGB-encoded: the picture as shown.");
}

}  // namespace penumbra::studio::python
