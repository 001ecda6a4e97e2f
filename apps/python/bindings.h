// SPDX-License-Identifier: Apache-2.0
// The parts of the module, in the order in which they must be added: what a later one says of its arguments
// names the types of the earlier ones.
#pragma once

#include <pybind11/pybind11.h>

namespace penumbra::studio::python {

/// C++'s exceptions become those of penumbra/__init__.py, with the same words.
void translateErrors();

void addCamera(pybind11::module_& module);
void addMesh(pybind11::module_& module);
void addScenes(pybind11::module_& module);
void addFrame(pybind11::module_& module);
void addRenderer(pybind11::module_& module);
void addJudging(pybind11::module_& module);

}  // namespace penumbra::studio::python
