// SPDX-License-Identifier: Apache-2.0
#include "apps/python/mesh.h"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <numeric>

#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "studio/errors.h"
#include "studio/scene/gltf/mesh.h"

namespace penumbra::studio::python {
namespace {

namespace py = pybind11;

constexpr std::array<float, 3> grey = {0.6f, 0.6f, 0.6f};

/// Normals that differ at one vertex from triangle to triangle: no vertex is shared.
void shadeFlat(Mesh& mesh) {
    std::vector<glm::vec3> corners;
    for (const std::uint32_t index : mesh.indices) corners.push_back(mesh.positions[index]);
    mesh.positions = std::move(corners);
    std::iota(mesh.indices.begin(), mesh.indices.end(), 0u);
    mesh.normals = gltf::flatNormals(mesh.positions);
}

std::vector<glm::vec3> unitNormals(const py::object& given, const Mesh& mesh, const std::string& what) {
    std::vector<glm::vec3> normals = toVectors(given, what);
    if (normals.size() != mesh.positions.size())
        throw UsageError(
            fmt::format("{}: there are {} for {} vertices", what, normals.size(), mesh.positions.size()));
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const float length = glm::length(normals[i]);
        if (!(length > 0)) throw UsageError(fmt::format("{}[{}] has no direction", what, i));
        normals[i] /= length;
    }
    return normals;
}

ArrayMesh makeMesh(const py::object& positions, const py::object& triangles, const std::string& name,
                   const std::array<float, 3>& color, const py::object& normals, bool casts, bool receives) {
    const std::string where = fmt::format("mesh '{}': ", name);
    ArrayMesh made{.color = {color[0], color[1], color[2]}, .casts = casts, .receives = receives};
    for (const float channel : color) {
        if (!(channel >= 0 && channel <= 1))
            throw UsageError(where + "color must be three numbers from 0 to 1");
    }
    made.mesh.name = name;
    made.mesh.positions = toVectors(positions, where + "positions");
    made.mesh.indices = toIndices(triangles, made.mesh.positions.size(), where + "triangles");
    if (made.mesh.indices.empty()) throw UsageError(where + "it has no triangles");
    if (!normals.is_none())
        made.mesh.normals = unitNormals(normals, made.mesh, where + "normals");
    else
        shadeFlat(made.mesh);
    return made;
}

}  // namespace

void addMesh(py::module_& module) {
    py::class_<ArrayMesh>(module, "Mesh", R"(Triangles in the world, out of arrays, which are copied.

positions: (vertices, 3), metres, +Y up.
triangles: (triangles, 3), integers, indices of vertices; counter-clockwise seen from outside. Both sides block light.
name: differs from those of the scene's other meshes.
color: linear Rec. 709, three numbers from 0 to 1; of the picture, not of shadows.
normals: (vertices, 3), for shading; without them each triangle is flat. Shadows need none.
casts, receives: whether it blocks light, and whether shadows fall on it. A ground under which nothing is seen
  costs least with casts=False.

Raises UsageError where an array is not as said.)")
        .def(py::init(&makeMesh), py::arg("positions"), py::arg("triangles"), py::kw_only(),
             py::arg("name") = "mesh", py::arg_v("color", grey, "(0.6, 0.6, 0.6)"),
             py::arg("normals") = py::none(), py::arg("casts") = true, py::arg("receives") = true)
        .def_property_readonly(
            "name", [](const ArrayMesh& mesh) { return mesh.mesh.name; }, "As given.")
        .def_property_readonly(
            "triangle_count", [](const ArrayMesh& mesh) { return mesh.mesh.indices.size() / 3; },
            "How many triangles it has.");
}

}  // namespace penumbra::studio::python
