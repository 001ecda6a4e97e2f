// SPDX-License-Identifier: Apache-2.0
#include "apps/penumbra/arguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "studio/errors.h"
#include "studio/scene/look_at.h"

namespace penumbra::studio {
namespace {

std::optional<int> parseInt(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

glm::vec3 parsePoint(std::string_view flag, const std::string& text) {
    glm::vec3 point(0);
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

void addFileFlags(CLI::App& command, SceneArguments& arguments) {
    command.add_option("--lights", arguments.lightsFile,
                       "lights from this file instead of SCENE.lights.json");
    command.add_option("--scene", arguments.sceneIndex, "which scene of the file, by index");
    command.add_option("--animation", arguments.animation, "which animation plays, by index; -1: none")
        ->capture_default_str();
}

void addViewFlags(CLI::App& command, SceneArguments& arguments) {
    command.add_option("--size", arguments.size, "WIDTHxHEIGHT in pixels")->capture_default_str();
    command.add_option("--camera", arguments.camera, "a camera of the scene, by name or index");
    CLI::Option* from = command
                            .add_option("--look-from", arguments.lookFrom,
                                        "X,Y,Z in metres: a camera of your own (--look-from=-1,2,3)")
                            ->excludes("--camera");
    CLI::Option* at =
        command.add_option("--look-at", arguments.lookAt, "X,Y,Z: what --look-from looks at")->needs(from);
    from->needs(at);
    command.add_option("--fov", arguments.fov_deg, "degrees from bottom to top that --look-from sees")
        ->needs(from)
        ->check(CLI::Range(0.01f, 179.0f))
        ->capture_default_str();
    command
        .add_option("--ortho-height", arguments.orthoHeight_m, "metres: --look-from sees without perspective")
        ->needs(from)
        ->excludes("--fov")
        ->check(CLI::PositiveNumber);
    command.add_option("--time", arguments.time_s, "moment of the animation, in seconds")
        ->capture_default_str();
    command.add_option("--device", arguments.device, "index from 'penumbra list devices'");
}

}  // namespace

void SceneArguments::addSceneTo(CLI::App& command, bool required) {
    command.add_option("SCENE", scene, "a glTF 2.0 file (.gltf, .glb) or the name of a built-in scene")
        ->required(required);
    addFileFlags(command, *this);
}

void SceneArguments::addTo(CLI::App& command) {
    addSceneTo(command);
    addViewFlags(command, *this);
}

void SceneArguments::addFlagsTo(CLI::App& command) {
    addFileFlags(command, *this);
    addViewFlags(command, *this);
}

OpenOptions SceneArguments::openOptions() const {
    OpenOptions options{.animation = animation, .scene = sceneIndex};
    if (lightsFile) options.lightsFile = *lightsFile;
    return options;
}

Scene SceneArguments::open() const {
    Scene opened = openScene(scene, openOptions());
    for (const std::string& warning : opened.warnings) spdlog::warn("{}", warning);
    return opened;
}

Camera SceneArguments::cameraIn(const SceneMoment& moment) const {
    if (!lookFrom) return findCamera(moment, camera);
    const LookAt look{.eye = parsePoint("--look-from", *lookFrom),
                      .target = parsePoint("--look-at", *lookAt),
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
      camera(arguments.cameraIn(moment)),
      workbench(arguments.device) {
    workbench.requireSize(size);
    workbench.open(scene);
}

std::vector<std::string> techniqueNames(const std::string& list) {
    std::vector<std::string> names;
    if (list == "all") {
        for (const TechniqueInfo& info : techniqueCatalog()) names.emplace_back(info.name);
        return names;
    }
    std::vector<std::string_view> known;
    for (const TechniqueInfo& info : allTechniques()) known.push_back(info.name);
    for (const std::string& name : CLI::detail::split(list, ',')) {
        if (std::ranges::find(known, name) == known.end()) {
            throw UsageError(
                fmt::format("there is no technique '{}'; there are: {}", name, fmt::join(known, ", ")));
        }
        names.push_back(name);
    }
    return names;
}

std::vector<std::pair<std::string, std::string>> parseSettings(const std::vector<std::string>& settings) {
    std::vector<std::pair<std::string, std::string>> parsed;
    for (const std::string& setting : settings) {
        const std::size_t equals = setting.find('=');
        if (equals == std::string::npos) {
            throw UsageError(fmt::format("--set '{}' is not KEY=VALUE", setting));
        }
        parsed.emplace_back(setting.substr(0, equals), setting.substr(equals + 1));
    }
    return parsed;
}

void applySettings(Technique& technique, const std::vector<std::string>& settings) {
    for (const auto& [name, value] : parseSettings(settings)) setParameter(technique, name, value);
}

Metadata pictureMetadata(const std::string& commandLine) {
    return {{"Software", "penumbra " PENUMBRA_VERSION}, {"penumbra:command", commandLine}};
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
