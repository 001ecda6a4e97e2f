// SPDX-License-Identifier: Apache-2.0
#include "apps/python/renderer.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>

#include "apps/python/bindings.h"
#include "apps/python/progress.h"
#include "studio/errors.h"
#include "studio/frame/frame_renderer.h"
#include "studio/workbench/parameter_list.h"
#include "studio/workbench/reference_technique.h"
#include "studio/workbench/settle.h"

namespace penumbra::studio::python {
namespace {

namespace py = pybind11;

/// As setParameter reads it: 64, 0.5 and "5x5" as Python writes them, True and False without capitals.
std::string textOf(const py::handle& value) {
    const std::string text = py::str(value);
    if (text == "True") return "true";
    if (text == "False") return "false";
    return text;
}

std::vector<std::pair<std::string, std::string>> settingsOf(const py::dict& parameters) {
    std::vector<std::pair<std::string, std::string>> settings;
    for (const auto& [name, value] : parameters)
        settings.emplace_back(std::string(py::str(name)), textOf(value));
    return settings;
}

/// The value as Python has such values, without a limit None.
py::object limitOf(const ParameterDescription& parameter, double value) {
    if (!std::isfinite(value)) return py::none();
    if (parameter.kind == ParameterDescription::Kind::integer) return py::int_(std::int64_t(value));
    return py::float_(value);
}

py::object defaultOf(const ParameterDescription& parameter) {
    switch (parameter.kind) {
        case ParameterDescription::Kind::boolean:
            return py::bool_(parameter.value == "true");
        case ParameterDescription::Kind::integer:
            return py::int_(py::str(parameter.value));
        case ParameterDescription::Kind::real:
            return py::float_(py::str(parameter.value));
        case ParameterDescription::Kind::choice:
            break;
    }
    return py::str(parameter.value);
}

/// As `list parameters --json` has it.
py::dict dictOf(const ParameterDescription& parameter) {
    using Kind = ParameterDescription::Kind;
    py::dict dict;
    dict["name"] = parameter.name;
    dict["type"] = nameOf(parameter.kind);
    dict["unit"] = parameter.unit;
    dict["default"] = defaultOf(parameter);
    dict["help"] = parameter.help;
    if (parameter.kind == Kind::integer || parameter.kind == Kind::real) {
        dict["min"] = limitOf(parameter, parameter.min);
        dict["max"] = limitOf(parameter, parameter.max);
    }
    if (parameter.kind == Kind::choice) dict["choices"] = parameter.choices;
    return dict;
}

py::dict techniques() {
    py::dict summaries;
    for (const TechniqueInfo& info : allTechniques()) summaries[py::str(info.name)] = info.summary;
    return summaries;
}

py::list devices() {
    py::list all;
    for (const HeadlessDevice& device : listHeadlessDevices()) {
        py::dict dict;
        dict["name"] = device.name;
        dict["usable"] = device.usable;
        dict["why_not"] = device.whyNot;
        all.append(dict);
    }
    return all;
}

}  // namespace

/// A call's time with the device, whose context is current on the calling thread for as long.
class Renderer::Turn {
  public:
    explicit Turn(Renderer& renderer) : renderer_(renderer) {
        if (renderer_.isAtWork_.test_and_set()) {
            throw UsageError(
                "this renderer is at work in another call: a thread, or a callback, needs one of its own");
        }
        renderer_.workbench_->makeCurrent();
    }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
    ~Turn() {
        renderer_.workbench_->context().makeNoneCurrent();
        renderer_.isAtWork_.clear();
    }

  private:
    Renderer& renderer_;
};

Renderer::Renderer(std::optional<int> device) : workbench_(std::make_unique<Workbench>(device)) {
    workbench_->context().makeNoneCurrent();
}

Renderer::~Renderer() {
    workbench_->makeCurrent();
}

Frame Renderer::render(const std::shared_ptr<Scene>& scene, const RenderOptions& options) {
    const Turn turn(*this);
    Rendered rendered;
    {
        const py::gil_scoped_release unlocked;
        rendered = run(scene, options);
    }
    return Frame(std::move(rendered));
}

Rendered Renderer::run(const std::shared_ptr<Scene>& scene, const RenderOptions& options) {
    if (!std::isfinite(options.time_s)) throw UsageError("time must be a finite number of seconds");
    if (options.exposure_ev && !std::isfinite(*options.exposure_ev))
        throw UsageError("exposure must be a finite number (EV at ISO 100)");
    if (options.timedRuns < 0) throw UsageError("timed_runs must be 0 or more");
    workbench_->requireSize(options.size);
    const SceneMoment moment = scene->at(options.time_s);
    const Camera camera = chosenCamera(options.camera, *scene, moment);
    const std::unique_ptr<Technique> technique = workbench_->makeTechnique(options.technique);
    for (const auto& [name, value] : options.settings) setParameter(*technique, name, value);

    if (open_ != scene) {
        workbench_->open(*scene);
        open_ = scene;
    }
    workbench_->frame().setExposure(options.exposure_ev);
    settle(
        *workbench_, [&](const Light&) -> Technique& { return *technique; }, moment, camera, options.size);

    const Progress progress(options.progress, *workbench_);
    const double all = double(std::max<std::size_t>(moment.lights.size(), 1));
    double lightsBegun = 0;
    if (auto* reference = dynamic_cast<ReferenceTechnique*>(technique.get()))
        reference->setProgress([&](double share) { progress((lightsBegun - 1 + share) / all); });
    const auto techniqueOf = [&](const Light&) -> Technique& {
        progress(lightsBegun++ / all);
        return *technique;
    };
    Rendered rendered{.result = workbench_->run(options.technique, techniqueOf, moment, camera, options.size,
                                                options.timedRuns)};
    const FrameRenderer& frame = workbench_->frame();
    rendered.surfaces = readSurfaces(frame.gbuffer().view());
    rendered.illuminance =
        readTexture(frame.illuminance().name(), options.size.width_px, options.size.height_px, 1);
    progress(1);
    return rendered;
}

py::list Renderer::parameters(const std::string& technique) {
    const Turn turn(*this);
    py::list all;
    for (const ParameterDescription& parameter : describeParameters(*workbench_->makeTechnique(technique)))
        all.append(dictOf(parameter));
    return all;
}

void addRenderer(py::module_& module) {
    module.def(
        "techniques", &techniques,
        "What can be rendered with, the ray-traced \"reference\" included: dict of name to what it is.");
    module.def("devices", &devices,
               "What a Renderer can be made on, by index: list of {\"name\", \"usable\", \"why_not\"}.");

    py::class_<Renderer>(module, "Renderer", R"(Renders, without a window, on an OpenGL 4.5 device.

device: an index into devices(); without, the first that is usable, GPUs before software.

Any thread may call it, one at a time; several may work at once, each for a thread. Keep it: making one compiles.
Raises DeviceError where there is no usable OpenGL.)")
        .def(py::init<std::optional<int>>(), py::arg("device") = py::none())
        .def_property_readonly("device", &Renderer::device, "As the driver calls it.")
        .def_property_readonly(
            "clock", &Renderer::clock,
            "What timed_runs are measured by: \"GPU timer queries\" or \"process CPU time\".")
        .def(
            "parameters", &Renderer::parameters, py::arg("technique"),
            R"(What can be set of a technique: list of dicts "name", "type" ("boolean", "integer", "real", "choice"),
"unit", "default", "help"; of numbers "min" and "max", None without a limit; of choices "choices".

Raises UsageError for an unknown technique, listing those there are.)")
        .def(
            "render",
            [](Renderer& renderer, const std::shared_ptr<Scene>& scene, const std::string& technique,
               const py::dict& parameters, std::pair<int, int> size, const CameraChoice& camera, double time,
               std::optional<float> exposure, int timedRuns, const py::object& progress) {
                return renderer.render(scene, {.technique = technique,
                                               .settings = settingsOf(parameters),
                                               .size = {size.first, size.second},
                                               .camera = camera,
                                               .time_s = time,
                                               .exposure_ev = exposure,
                                               .timedRuns = timedRuns,
                                               .progress = progress});
            },
            py::arg("scene").none(false), py::arg("technique") = std::string(defaultTechnique()),
            py::arg("parameters") = py::dict(), py::kw_only(), py::arg("size") = std::pair(960, 540),
            py::arg("camera") = py::none(), py::arg("time") = 0.0, py::arg("exposure") = py::none(),
            py::arg("timed_runs") = 0, py::arg("progress") = py::none(),
            R"(Renders all lights of a scene and gives a Frame, the same bits for the same arguments.

technique: a name of techniques(); "reference" traces rays with Embree.
parameters: dict of name to value; see parameters().
size: (width, height), pixels.
camera: a Camera, or one of the scene's by name or index; its first without.
time: seconds, of the scene's animations.
exposure: EV at ISO 100 of Frame.display; chosen by the picture without.
timed_runs: how often each light is rendered once more with the clock running, for Frame.milliseconds.
progress: called now and then with the share that is done, 0 to 1, and maybe from another thread. What it raises, as
  Ctrl-C does, ends the render and is raised here.

Raises UsageError, and DeviceError where the device has no room.)");
}

}  // namespace penumbra::studio::python
