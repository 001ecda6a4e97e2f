// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>

#include <array>
#include <cmath>

#include "apps/python/bindings.h"
#include "apps/python/camera.h"
#include "studio/errors.h"
#include "studio/workbench/workbench.h"

namespace penumbra::studio::python {
namespace {

namespace py = pybind11;

using Point = std::array<double, 3>;

constexpr float narrowest_deg = 0.01f, widest_deg = 179;

OwnCamera makeCamera(const Point& lookFrom, const Point& lookAt, float fov_deg,
                     std::optional<float> height_m) {
    const OwnCamera made{.lookFrom = {lookFrom[0], lookFrom[1], lookFrom[2]},
                         .lookAt = {lookAt[0], lookAt[1], lookAt[2]},
                         .fov_deg = fov_deg,
                         .height_m = height_m};
    for (int axis = 0; axis < 3; ++axis) {
        if (!std::isfinite(made.lookFrom[axis]) || !std::isfinite(made.lookAt[axis]))
            throw UsageError("look_from and look_at must be three finite numbers each");
    }
    if (glm::vec3(made.lookFrom) == glm::vec3(made.lookAt))
        throw UsageError("look_from and look_at are the same place");
    if (!(fov_deg >= narrowest_deg && fov_deg <= widest_deg))
        throw UsageError("fov must be from 0.01 to 179 degrees");
    if (height_m && !(std::isfinite(*height_m) && *height_m > 0))
        throw UsageError("height must be a number of metres above 0");
    return made;
}

}  // namespace

Camera chosenCamera(const CameraChoice& choice, const Scene& scene, const SceneMoment& moment) {
    if (!choice) return findCamera(moment, std::nullopt);
    if (const int* index = std::get_if<int>(&*choice)) return findCamera(moment, std::to_string(*index));
    if (const std::string* name = std::get_if<std::string>(&*choice)) return findCamera(moment, *name);
    const OwnCamera& own = std::get<OwnCamera>(*choice);
    const auto inWorld = [&](const glm::dvec3& place) {
        return glm::vec3(scene.worldFromFile * glm::dvec4(place, 1));
    };
    return lookAtCamera({.eye = inWorld(own.lookFrom),
                         .target = inWorld(own.lookAt),
                         .fov_deg = own.fov_deg,
                         .height_m = own.height_m});
}

void addCamera(py::module_& module) {
    py::class_<OwnCamera>(module, "Camera", R"(A camera of one's own, upright.

look_from, look_at: two places, three numbers each, in the coordinates of the scene's file (metres, +Y up, unless it was
  opened otherwise).
fov: degrees from the picture's bottom to its top, 0.01 to 179.
height: metres from bottom to top: it then sees without perspective, and fov is of no effect.

Raises UsageError where the two places are one.)")
        .def(py::init(&makeCamera), py::arg("look_from"), py::arg("look_at"), py::kw_only(),
             py::arg("fov") = 40, py::arg("height") = py::none());
}

}  // namespace penumbra::studio::python
