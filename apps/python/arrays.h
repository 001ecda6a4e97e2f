// SPDX-License-Identifier: Apache-2.0
// Between NumPy's arrays, or what it makes arrays of, and our own types.
#pragma once

#include <pybind11/numpy.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "studio/image/image.h"

namespace penumbra::studio::python {

/// The image's pixels, float32 of shape (height, width) or (height, width, channels). The array owns them:
/// nothing is copied.
pybind11::array_t<float> toArray(Image&& image);

/// Copies numbers of shape (height, width) or (height, width, channels). `what` names the array in the
/// UsageError that anything else is.
Image toImage(const pybind11::object& given, const std::string& what);

/// Copies finite numbers of shape (count, 3); the same.
std::vector<glm::vec3> toVectors(const pybind11::object& given, const std::string& what);

/// Copies triangles, integers of shape (count, 3) of which each is an index below `vertices`; the same.
std::vector<std::uint32_t> toIndices(const pybind11::object& given, std::size_t vertices,
                                     const std::string& what);

}  // namespace penumbra::studio::python
