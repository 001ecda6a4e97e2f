// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/numpy.h>

#include "studio/frame/surfaces.h"
#include "studio/workbench/workbench.h"

namespace penumbra::studio::python {

/// What a render gives, on the CPU.
struct Rendered {
    TechniqueResult result;
    Surfaces surfaces;
    Image illuminance;  ///< lux
};

/// The same as Python has it.
struct Frame {
    /// Takes the pixels over.
    explicit Frame(Rendered&& rendered);

    std::string technique;
    std::vector<std::string> lights;
    float exposure_ev = 0;
    pybind11::dict visibility, reach, statistics, milliseconds;  ///< by light
    pybind11::array_t<float> depth, normals, illuminance, radiance, display;
};

}  // namespace penumbra::studio::python
