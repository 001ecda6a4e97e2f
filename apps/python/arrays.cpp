// SPDX-License-Identifier: Apache-2.0
#include "apps/python/arrays.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <memory>
#include <string_view>
#include <utility>

#include "studio/errors.h"

namespace penumbra::studio::python {
namespace {

namespace py = pybind11;

constexpr int contiguous = py::array::c_style | py::array::forcecast;

[[noreturn]] void fail(const py::array& array, const std::string& what, std::string_view expected) {
    const std::vector<py::ssize_t> shape(array.shape(), array.shape() + array.ndim());
    throw UsageError(fmt::format("{} must be {}, not {} of shape ({})", what, expected,
                                 std::string(py::str(array.dtype())), fmt::join(shape, ", ")));
}

/// Kinds as NumPy's dtype.kind names them.
bool isOfKind(const py::array& array, std::string_view kinds) {
    return kinds.find(array.dtype().kind()) != std::string_view::npos;
}
constexpr std::string_view integers = "iu", numbers = "iuf";

bool isListOfThree(const py::array& array) {
    return array.ndim() == 2 && array.shape(1) == 3;
}

}  // namespace

py::array_t<float> toArray(Image&& image) {
    std::vector<py::ssize_t> shape = {image.height_px, image.width_px};
    if (image.channels > 1) shape.push_back(image.channels);
    auto values = std::make_unique<std::vector<float>>(std::move(image.values));
    const py::capsule owner(values.get(), [](void* kept) { delete static_cast<std::vector<float>*>(kept); });
    return py::array_t<float>(std::move(shape), values.release()->data(), owner);
}

Image toImage(const py::object& given, const std::string& what) {
    const py::array array(given);
    if (!isOfKind(array, numbers) || (array.ndim() != 2 && array.ndim() != 3))
        fail(array, what, "numbers of shape (height, width) or (height, width, channels)");
    const auto floats = py::array_t<float, contiguous>::ensure(array);
    Image image;
    image.height_px = int(array.shape(0));
    image.width_px = int(array.shape(1));
    image.channels = array.ndim() == 3 ? int(array.shape(2)) : 1;
    image.values.assign(floats.data(), floats.data() + floats.size());
    return image;
}

std::vector<glm::vec3> toVectors(const py::object& given, const std::string& what) {
    const py::array array(given);
    if (!isOfKind(array, numbers) || !isListOfThree(array)) fail(array, what, "numbers of shape (count, 3)");
    const auto floats = py::array_t<float, contiguous>::ensure(array);
    std::vector<glm::vec3> vectors(std::size_t(floats.shape(0)));
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            vectors[i][axis] = floats.at(i, axis);
            if (!std::isfinite(vectors[i][axis]))
                throw UsageError(fmt::format("{}[{}] is not finite", what, i));
        }
    }
    return vectors;
}

std::vector<std::uint32_t> toIndices(const py::object& given, std::size_t vertices, const std::string& what) {
    const py::array array(given);
    if (!isOfKind(array, integers) || !isListOfThree(array))
        fail(array, what, "integers of shape (count, 3)");
    const auto read = py::array_t<std::int64_t, contiguous>::ensure(array);
    std::vector<std::uint32_t> indices;
    indices.reserve(std::size_t(read.size()));
    for (py::ssize_t i = 0; i < read.shape(0); ++i) {
        for (int corner = 0; corner < 3; ++corner) {
            const std::int64_t index = read.at(i, corner);
            if (index < 0 || std::size_t(index) >= vertices)
                throw UsageError(fmt::format("{}[{}] names vertex {} of {}, which count from 0", what, i,
                                             index, vertices));
            indices.push_back(std::uint32_t(index));
        }
    }
    return indices;
}

}  // namespace penumbra::studio::python
