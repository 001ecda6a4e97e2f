// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/settings.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "studio/image/atomic_file.h"

namespace penumbra::studio::viewer {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t maxRecent = 10;
constexpr std::size_t maxFile_bytes = 1 << 20;

fs::path baseFolder(const char* variable, const char* beneathHome) {
    const char* const chosen = std::getenv(variable);
    if (chosen != nullptr && fs::path(chosen).is_absolute()) return fs::path(chosen) / "penumbra";
    const char* const home = std::getenv("HOME");
    return fs::path(home == nullptr ? "/" : home) / beneathHome / "penumbra";
}

Json toJson(const ParameterValues& values) {
    Json json = Json::object();
    for (const auto& [key, value] : values) json[key] = value;
    return json;
}

ParameterValues parametersFrom(const Json& json) {
    ParameterValues values;
    for (const auto& [key, value] : json.items()) values.emplace_back(key, value.get<std::string>());
    return values;
}

Settings settingsFrom(const Json& json) {
    Settings settings;
    const auto read = [&](const char* key, auto& value) {
        if (const auto found = json.find(key); found != json.end()) found->get_to(value);
    };
    read("width", settings.width);
    read("height", settings.height);
    read("resolution_scale", settings.resolutionScale);
    read("reference_samples", settings.referenceSamples);
    read("reference_runs", settings.referenceRuns);
    read("technique", settings.technique);
    read("other", settings.other);
    read("recent_files", settings.recentFiles);
    read("seen_help", settings.seenHelp);
    if (const auto found = json.find("parameters"); found != json.end()) {
        for (const auto& [name, values] : found->items()) settings.parameters[name] = parametersFrom(values);
    }
    if (const auto found = json.find("presets"); found != json.end()) {
        for (const auto& [technique, presets] : found->items()) {
            for (const auto& [name, values] : presets.items()) {
                settings.presets[technique][name] = parametersFrom(values);
            }
        }
    }
    settings.width = std::clamp(settings.width, 320, 16384);
    settings.height = std::clamp(settings.height, 240, 16384);
    settings.referenceSamples = std::clamp(settings.referenceSamples, 4, 65536);
    // Written so that what is not a number becomes the default.
    if (!(settings.resolutionScale >= 0.125f && settings.resolutionScale <= 2)) settings.resolutionScale = 0;
    settings.recentFiles.resize(std::min(settings.recentFiles.size(), maxRecent));
    return settings;
}

}  // namespace

void Settings::addRecent(const std::string& path) {
    std::erase(recentFiles, path);
    recentFiles.insert(recentFiles.begin(), path);
    recentFiles.resize(std::min(recentFiles.size(), maxRecent));
}

fs::path settingsFile() {
    return baseFolder("XDG_CONFIG_HOME", ".config") / "viewer.json";
}

fs::path dataFolder() {
    return baseFolder("XDG_DATA_HOME", ".local/share");
}

Settings loadSettings(const fs::path& file) {
    std::error_code error;
    if (!fs::exists(file, error)) return {};
    try {
        const std::vector<std::byte> bytes = readWholeFile(file, maxFile_bytes);
        const auto* const text = reinterpret_cast<const char*>(bytes.data());
        return settingsFrom(Json::parse(text, text + bytes.size()));
    } catch (const std::exception& problem) {
        spdlog::warn("{}: settings are not understood and start anew: {}", file.string(), problem.what());
        return {};
    }
}

void saveSettings(const Settings& settings, const fs::path& file) {
    Json json = {{"width", settings.width},
                 {"height", settings.height},
                 {"resolution_scale", settings.resolutionScale},
                 {"reference_samples", settings.referenceSamples},
                 {"reference_runs", settings.referenceRuns},
                 {"technique", settings.technique},
                 {"other", settings.other},
                 {"recent_files", settings.recentFiles},
                 {"parameters", Json::object()},
                 {"presets", Json::object()},
                 {"seen_help", settings.seenHelp}};
    for (const auto& [name, values] : settings.parameters) json["parameters"][name] = toJson(values);
    for (const auto& [technique, presets] : settings.presets) {
        for (const auto& [name, values] : presets) json["presets"][technique][name] = toJson(values);
    }
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    writeFileAtomically(file, json.dump(2) + "\n");
}

}  // namespace penumbra::studio::viewer
