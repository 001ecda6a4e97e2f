// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <span>

#include "apps/python/bindings.h"
#include "apps/python/mesh.h"
#include "studio/errors.h"
#include "studio/scene/builtin/builtin.h"
#include "studio/scene/builtin/scene_builder.h"
#include "studio/scene/defaults.h"
#include "studio/scene/lights/sidecar.h"
#include "studio/scene/open_scene.h"

namespace penumbra::studio::python {
namespace {

namespace py = pybind11;

/// Never changes once it is made: renderers keep what they have made of it.
using ScenePointer = std::shared_ptr<Scene>;

/// Python's warnings, from those of `scene` on.
void warn(const Scene& scene, std::size_t first = 0) {
    for (std::size_t i = first; i < scene.warnings.size(); ++i) {
        if (PyErr_WarnEx(PyExc_UserWarning, scene.warnings[i].c_str(), 1) != 0) throw py::error_already_set();
    }
}

/// Dicts in the words of docs/lights.md as the text of a file of lights, a light a line, so that what is
/// wrong is said of "lights:N", the Nth.
std::string jsonOf(const py::sequence& lights) {
    const py::object dumps = py::module_::import("json").attr("dumps");
    const py::cpp_function asList([](const py::object& other) { return other.attr("tolist")(); });
    std::string text = R"({"version": 1, "lights": [)";
    for (std::size_t i = 0; i < lights.size(); ++i) {
        text += i == 0 ? "" : ",\n";
        text += dumps(lights[i], py::arg("default") = asList).cast<std::string>();
    }
    return text + "]}";
}

void light(Scene& scene, const py::sequence& lights, std::vector<SurfaceRule> nodes = {}) {
    if (lights.empty()) throw UsageError("a scene needs a light: lights=[{'name': ..., 'type': ...}]");
    Sidecar sidecar = parseSidecar(jsonOf(lights), "lights");
    sidecar.surfaces.nodes = std::move(nodes);
    applySidecar(scene, sidecar, std::filesystem::current_path());
}

/// One of `legal` by name, if it is given. Throws UsageError.
template <typename Value>
std::optional<Value> oneOf(std::string_view what, const std::optional<std::string>& name,
                           NamedValues<Value> legal) {
    if (!name) return {};
    if (const std::optional<Value> value = valueNamed(legal, *name)) return value;
    throw UsageError(fmt::format("{}='{}' is none of: {}", what, *name, fmt::join(namesIn(legal), ", ")));
}

ScenePointer open(const std::filesystem::path& name, const std::optional<std::filesystem::path>& lights,
                  std::optional<int> scene, const std::optional<std::vector<int>>& animations,
                  const std::optional<std::string>& glass, const std::optional<std::string>& unit,
                  const std::optional<std::string>& up) {
    const OpenOptions options{.lightsFile = lights,
                              .animations = animations,
                              .scene = scene,
                              .reading = {.unit_m = oneOf("unit", unit, lengthUnits_m()),
                                          .up = oneOf("up", up, upAxisNames()),
                                          .glass = oneOf("glass", glass, glassNames())}};
    auto opened = std::make_shared<Scene>(openScene(name.string(), options));
    warn(*opened);
    return opened;
}

ScenePointer build(const std::vector<ArrayMesh>& meshes, const py::sequence& lights,
                   const std::string& name) {
    if (meshes.empty())
        throw UsageError("a scene needs a mesh: meshes=[penumbra.Mesh(positions, triangles)]");
    SceneBuilder builder(name);
    std::vector<SurfaceRule> nodes;
    std::set<std::string> names;
    for (const ArrayMesh& given : meshes) {
        if (!names.insert(given.mesh.name).second)
            throw UsageError(fmt::format("two meshes are named '{}': give each a name=", given.mesh.name));
        builder.place(given.mesh.name, builder.mesh(given.mesh.name, given.mesh, given.color),
                      at(glm::vec3(0)));
        nodes.push_back({.name = given.mesh.name, .casts = given.casts, .receives = given.receives});
    }
    auto built = std::make_shared<Scene>(std::move(builder).build());
    light(*built, lights, std::move(nodes));
    warn(*built);
    addDefaults(*built, name);
    return built;
}

ScenePointer withLights(const Scene& scene, const py::sequence& lights) {
    auto lit = std::make_shared<Scene>(scene);
    light(*lit, lights);
    warn(*lit, scene.warnings.size());
    return lit;
}

/// Names of lights or cameras.
template <typename Named>
std::vector<std::string> namesOf(const std::vector<Named>& all) {
    std::vector<std::string> names;
    for (const Named& one : all) names.push_back(one.name);
    return names;
}

std::size_t triangleCount(const Scene& scene) {
    std::size_t count = 0;
    for (const Instance& instance : scene.at(0).instances)
        count += scene.meshes[std::size_t(instance.mesh)].indices.size() / 3;
    return count;
}

py::dict builtins() {
    py::dict scenes;
    for (const BuiltinInfo& info : builtinScenes()) scenes[py::str(info.name)] = info.summary;
    return scenes;
}

}  // namespace

void addScenes(py::module_& module) {
    py::class_<Scene, ScenePointer>(
        module, "Scene",
        "What is rendered: surfaces, lights and cameras. Made by open_scene or build_scene; never changes.")
        .def_readonly("name", &Scene::name, "As it was built, or as the file has it.")
        .def_readonly("warnings", &Scene::warnings,
                      "What is odd, each with its place in the file: list of str.")
        .def_property_readonly("duration", &Scene::duration_s,
                               "Seconds until its animations repeat; 0: still.")
        .def_property_readonly(
            "lights", [](const Scene& scene) { return namesOf(scene.at(0).lights); }, "Names: list of str.")
        .def_property_readonly(
            "cameras", [](const Scene& scene) { return namesOf(scene.at(0).cameras); }, "Names: list of str.")
        .def_property_readonly("triangle_count", &triangleCount, "How many triangles are drawn.")
        .def(
            "with_lights", &withLights, py::arg("lights"),
            R"(The same scene under other lights: dicts in the words of docs/lights.md, as build_scene takes them.

Raises InputError ("lights:2: ..." is of the second light).)");

    module.def("scenes", &builtins, "The built-in scenes: dict of name to what it shows.");
    module.def("open_scene", &open, py::arg("name"), py::kw_only(), py::arg("lights") = py::none(),
               py::arg("scene") = py::none(), py::arg("animations") = py::none(),
               py::arg("glass") = py::none(), py::arg("unit") = py::none(), py::arg("up") = py::none(),
               R"(Opens a glTF 2.0 file (.gltf, .glb), or the built-in scene of that name (see scenes()).

lights: a file of lights (docs/lights.md) instead of NAME.lights.json beside the scene.
scene: which of the file's scenes, by index; its default without.
animations: indices of those that play together, [] for none; without, all that move different things.
glass: "clear" lets light through, "tinted" takes its share of it, "blocks" casts shadows.
unit: of the file's coordinates: "mm", "cm", "m", "in", "ft". up: its axis that points up, "y" or "z".
  Without these three, what the file of lights says counts, else "clear", "m", "y".

A scene without a light gets a key light, one without a camera gets one; Python's warnings say so, and all that is odd.
Raises InputError, which names the file, the place and the remedy.)");
    module.def("build_scene", &build, py::arg("meshes"), py::arg("lights"), py::kw_only(),
               py::arg("name") = "built", R"(Builds a scene that stands still.

meshes: sequence of Mesh, each of a name of its own.
lights: sequence of dicts in the words of docs/lights.md (metres, degrees, nits), for instance
  {"name": "key", "type": "RectLight", "width": 1, "height": 1, "intensity": 8000,
   "translation": [0, 4, 0], "aim": [0, 0, 0]}
  Values may be NumPy's. Files are looked for beneath the current folder.

Its one camera, "default", sees all of it from outside, or from within if it is a room.
Raises UsageError, and InputError for lights ("lights:2: ..." is of the second).)");
}

}  // namespace penumbra::studio::python
