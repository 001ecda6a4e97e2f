// SPDX-License-Identifier: Apache-2.0
#include "apps/penumbra/arguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>

#include "penumbra/version.h"
#include "studio/errors.h"
#include "studio/scene/lights/nearest_name.h"
#include "studio/scene/look_at.h"

namespace penumbra::studio {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// What floats of an orthographic camera can hold with room to spare.
constexpr double smallestView_m = 1e-6, largestView_m = 1e9;

std::optional<int> parseInt(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

glm::dvec3 parsePoint(std::string_view flag, const std::string& text) {
    glm::dvec3 point(0);
    const char* at = text.data();
    const char* const end = at + text.size();
    bool good = true;
    for (int i = 0; i < 3 && good; ++i) {
        const auto [next, error] = std::from_chars(at, end, point[i]);
        good = error == std::errc() && std::isfinite(point[i]) &&
               (i == 2 ? next == end : next != end && *next == ',');
        at = next + (i < 2);
    }
    if (!good)
        throw UsageError(fmt::format("{} '{}' is not X,Y,Z in metres, for instance 1,2.5,-3", flag, text));
    return point;
}

/// The value of a flag that was checked to be one of `table`, if it was given.
template <typename Value>
std::optional<Value> given(NamedValues<Value> table, const std::optional<std::string>& name) {
    if (!name) return {};
    return valueNamed(table, *name);
}

void addFileFlags(CLI::App& command, SceneArguments& arguments) {
    command.add_option("--lights", arguments.lightsFile,
                       "lights from this file instead of SCENE.lights.json");
    arguments.sun.addTo(command);
    command.add_option("--scene", arguments.sceneIndex, "which scene of the file, by index");
    command
        .add_option("--animation", arguments.animations,
                    "which animations play, by index (0,2; -1: none); else all that move different things")
        ->delimiter(',')
        ->allow_extra_args(false);
    command
        .add_option("--unit", arguments.unit,
                    "of the file's coordinates; else what the file of lights says, else m as in glTF")
        ->check(CLI::IsMember(namesIn(lengthUnits_m())));
    command
        .add_option("--up", arguments.up,
                    "which axis of the file points up; else what the file of lights says, else y as in glTF")
        ->check(CLI::IsMember(namesIn(upAxisNames())));
    command
        .add_option("--glass", arguments.glass,
                    "clear: glass lets light through; tinted: it takes its share; blocks: it casts shadows; "
                    "else what the file of lights says, else clear")
        ->check(CLI::IsMember(namesIn(glassNames())));
    command.add_option("--light-radius", arguments.lightRadius_m, "metres: for lamps that have no size")
        ->check(CLI::Range(1e-4f, 1e4f));
    command
        .add_option("--sun-angle", arguments.sunAngle_deg,
                    "degrees across: for distant lights that have no size (the sun: 0.53)")
        ->check(CLI::Range(1e-3f, 90.0f));
}

void addCameraFlags(CLI::App& command, SceneArguments& arguments) {
    command.add_option("--camera", arguments.camera, "a camera of the scene, by name or index");
    CLI::Option* from =
        command
            .add_option("--look-from", arguments.lookFrom,
                        "X,Y,Z in the file's coordinates: a camera of your own (--look-from=-1,2,3)")
            ->excludes("--camera");
    CLI::Option* at =
        command.add_option("--look-at", arguments.lookAt, "X,Y,Z: what --look-from looks at")->needs(from);
    from->needs(at);
    command.add_option("--fov", arguments.fov_deg, "degrees from bottom to top that --look-from sees")
        ->needs(from)
        ->check(finiteWithin(0.01, 179, "degrees"))
        ->capture_default_str();
    command
        .add_option("--ortho-height", arguments.orthoHeight_m, "metres: --look-from sees without perspective")
        ->needs(from)
        ->excludes("--fov")
        ->check(finiteWithin(smallestView_m, largestView_m, "metres"));
    command.add_option("--time", arguments.time_s, "moment of the animation, in seconds")
        ->check(finiteWithin(-infinity, infinity, "seconds"))
        ->capture_default_str();
}

void addViewFlags(CLI::App& command, SceneArguments& arguments) {
    command.add_option("--size", arguments.size, "WIDTHxHEIGHT in pixels")->capture_default_str();
    addCameraFlags(command, arguments);
    command.add_option("--device", arguments.device, "index from 'penumbra list devices'");
}

}  // namespace

void SunArguments::addTo(CLI::App& command) {
    CLI::Option* sun = command.add_option("--sun", place,
                                          "LAT,LON,ISO-TIME: the sun there and then, beside the lights of a "
                                          "file (--sun=52.52,13.405,2026-06-21T13:00+01:00)");
    command.add_option("--north", north_deg, "degrees from -Z to north, clockwise seen from above")
        ->needs(sun)
        ->check(CLI::Range(-360.0, 360.0))
        ->capture_default_str();
    command.add_flag("--no-refraction", noRefraction, "the sun as if there were no air to bend its light")
        ->needs(sun);
}

std::optional<SunOption> SunArguments::option() const {
    if (!place) return {};
    return SunOption{
        *place, parseSunPlace(*place, "--sun"), {.north_deg = north_deg, .refraction = !noRefraction}};
}

void SceneArguments::addSceneTo(CLI::App& command, bool required) {
    command.add_option("SCENE", scene, "a glTF 2.0 file (.gltf, .glb) or the name of a built-in scene")
        ->required(required);
    addFileFlags(command, *this);
}

void SceneArguments::addTo(CLI::App& command) {
    addSceneTo(command);
    addViewFlags(command, *this);
}

void SceneArguments::addCameraTo(CLI::App& command) {
    addCameraFlags(command, *this);
}

void SceneArguments::addFlagsTo(CLI::App& command) {
    addFileFlags(command, *this);
    addViewFlags(command, *this);
}

OpenOptions SceneArguments::openOptions() const {
    OpenOptions options{.sun = sun.option(),
                        .scene = sceneIndex,
                        .reading = {.unit_m = given(lengthUnits_m(), unit),
                                    .up = given(upAxisNames(), up),
                                    .glass = given(glassNames(), glass)},
                        .lightSizes = {lightRadius_m, glm::radians(sunAngle_deg)}};
    if (animations == std::vector{-1})
        options.animations.emplace();
    else if (!animations.empty())
        options.animations = animations;
    if (lightsFile) options.lightsFile = *lightsFile;
    return options;
}

Scene SceneArguments::open() const {
    Scene opened = openScene(scene, openOptions());
    for (const std::string& warning : opened.warnings) spdlog::warn("{}", warning);
    return opened;
}

Camera SceneArguments::cameraIn(const Scene& opened, const SceneMoment& moment) const {
    if (!lookFrom) return findCamera(moment, camera);
    const auto inWorld = [&](const char* flag, const std::string& text) {
        return glm::vec3(opened.worldFromFile * glm::dvec4(parsePoint(flag, text), 1));
    };
    const LookAt look{.eye = inWorld("--look-from", *lookFrom),
                      .target = inWorld("--look-at", *lookAt),
                      .fov_deg = fov_deg,
                      .height_m = orthoHeight_m};
    if (look.eye == look.target) throw UsageError("--look-from and --look-at are the same place");
    return lookAtCamera(look);
}

PictureSize SceneArguments::pictureSize() const {
    const std::size_t cross = size.find('x');
    const auto width = parseInt(std::string_view(size).substr(0, cross));
    const auto height =
        cross == std::string::npos ? std::nullopt : parseInt(std::string_view(size).substr(cross + 1));
    if (!width || !height || *width < 1 || *height < 1) {
        throw UsageError(
            fmt::format("--size '{}' is not WIDTHxHEIGHT in pixels, for instance 960x540", size));
    }
    return {*width, *height};
}

OpenedScene::OpenedScene(const SceneArguments& arguments)
    : size(arguments.pictureSize()),
      scene(arguments.open()),
      moment(scene.at(arguments.time_s)),
      camera(arguments.cameraIn(scene, moment)),
      workbench(arguments.device) {
    workbench.requireSize(size);
    workbench.open(scene);
}

Contender parseTechnique(const std::string& text) {
    std::vector<std::string> parts = CLI::detail::split(text, ':');
    Contender contender{.label = text, .technique = parts.front(), .settings = {}};
    std::vector<std::string_view> known;
    for (const TechniqueInfo& info : allTechniques()) known.push_back(info.name);
    if (std::ranges::find(known, contender.technique) == known.end()) {
        throw UsageError(fmt::format("there is no technique '{}'; there are: {}{}", contender.technique,
                                     fmt::join(known, ", "), didYouMean(contender.technique, known)));
    }
    for (auto part = parts.begin() + 1; part != parts.end(); ++part) {
        const std::size_t equals = part->find('=');
        if (equals == std::string::npos) {
            throw UsageError(fmt::format("-t '{}': '{}' is not KEY=VALUE, for instance {}:samples=64", text,
                                         *part, contender.technique));
        }
        contender.settings.emplace_back(part->substr(0, equals), part->substr(equals + 1));
    }
    return contender;
}

std::vector<Contender> parseContenders(const std::string& list, const std::vector<std::string>& settings) {
    std::vector<Contender> contenders;
    if (list == "all") {
        for (const TechniqueInfo& info : techniqueCatalog()) {
            contenders.push_back(parseTechnique(std::string(info.name)));
        }
    } else {
        for (const std::string& text : CLI::detail::split(list, ',')) {
            const Contender& added = contenders.emplace_back(parseTechnique(text));
            if (std::ranges::count(contenders, added.label, &Contender::label) > 1) {
                throw UsageError(fmt::format("-t '{}' names '{}' twice", list, text));
            }
        }
    }
    for (const std::string& text : settings) {
        const Setting setting = parseSetting(text);
        bool used = false;
        for (Contender& contender : contenders) {
            if (!setting.technique.empty() && setting.technique != contender.technique) continue;
            contender.settings.emplace_back(setting.key, setting.value);
            used = true;
        }
        if (!used) {
            throw UsageError(
                fmt::format("--set '{}': '{}' is none of the techniques of -t", text, setting.technique));
        }
    }
    return contenders;
}

Setting parseSetting(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) throw UsageError(fmt::format("--set '{}' is not KEY=VALUE", text));
    const std::size_t dot = text.find('.');
    const bool named = dot < equals;
    return {.technique = named ? text.substr(0, dot) : "",
            .key = named ? text.substr(dot + 1, equals - dot - 1) : text.substr(0, equals),
            .value = text.substr(equals + 1)};
}

CLI::Validator finiteWithin(double low, double high, const std::string& unit) {
    const std::string legal = std::isfinite(high)
                                  ? fmt::format("a number from {:g} to {:g} {}", low, high, unit)
                              : low > 0 ? fmt::format("a number of at least {:g} {}", low, unit)
                                        : fmt::format("a finite number of {}", unit);
    return CLI::Validator(
        [=](const std::string& text) {
            double value = 0;
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
            const bool good = error == std::errc() && end == text.data() + text.size() &&
                              std::isfinite(value) && value >= low && value <= high;
            return good ? std::string() : fmt::format("'{}' is not {}", text, legal);
        },
        "");
}

Metadata pictureMetadata(const std::string& commandLine) {
    return {{"Software", "penumbra " + std::string(version())}, {"penumbra:command", commandLine}};
}

void requireWritableFolder(const std::filesystem::path& folder, bool create) {
    const std::filesystem::path path = folder.empty() ? "." : folder;
    std::error_code error;
    if (create) std::filesystem::create_directories(path, error);
    if (!std::filesystem::is_directory(path, error)) {
        throw OutputError(fmt::format("{}: is no folder{}; name another place with -o", path.string(),
                                      create ? " and cannot be made one" : ""));
    }
    if (access(path.c_str(), W_OK) != 0) {
        throw OutputError(
            fmt::format("{}: no permission to write there; name another place with -o", path.string()));
    }
}

}  // namespace penumbra::studio
