// SPDX-License-Identifier: Apache-2.0
#include "apps/penumbra/arguments.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>

#include "studio/errors.h"

namespace penumbra::studio {
namespace {

std::optional<int> parseInt(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
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
    command.add_option("--time", arguments.time_s, "moment of the animation, in seconds")
        ->capture_default_str();
    command.add_option("--device", arguments.device, "index from 'penumbra list devices'");
}

}  // namespace

void SceneArguments::addSceneTo(CLI::App& command) {
    command.add_option("SCENE", scene, "a glTF 2.0 file (.gltf, .glb) or the name of a built-in scene")
        ->required();
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
      camera(findCamera(moment, arguments.camera)),
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
