// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/settings.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <stdexcept>

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

Json toJson(const RecentFile& file) {
    if (file.lights.empty()) return file.scene;
    return {{"scene", file.scene}, {"lights", file.lights}};
}

RecentFile recentFrom(const Json& json) {
    if (json.is_string()) return {json.get<std::string>(), ""};
    return {json.at("scene").get<std::string>(), json.at("lights").get<std::string>()};
}

Json toJson(const Bookmark& bookmark) {
    const LookAt& look = bookmark.look;
    Json json = {{"name", bookmark.name},
                 {"eye", {look.eye.x, look.eye.y, look.eye.z}},
                 {"target", {look.target.x, look.target.y, look.target.z}},
                 {"fov", look.fov_deg}};
    if (look.height_m) json["height"] = *look.height_m;
    return json;
}

Bookmark bookmarkFrom(const Json& json) {
    const auto vector = [&](const char* key) {
        const auto values = json.at(key).get<std::array<float, 3>>();
        return glm::vec3(values[0], values[1], values[2]);
    };
    Bookmark bookmark{
        json.at("name").get<std::string>(),
        {.eye = vector("eye"), .target = vector("target"), .fov_deg = json.at("fov").get<float>()}};
    if (json.contains("height")) bookmark.look.height_m = json.at("height").get<float>();
    if (!(glm::distance(bookmark.look.eye, bookmark.look.target) > 0))
        throw std::invalid_argument("a view looks at another point than its own");
    return bookmark;
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
    if (const auto found = json.find("recent_files"); found != json.end()) {
        for (const Json& file : *found) settings.recentFiles.push_back(recentFrom(file));
    }
    if (const auto found = json.find("bookmarks"); found != json.end()) {
        for (const auto& [scene, bookmarks] : found->items()) {
            for (const Json& bookmark : bookmarks)
                settings.bookmarks[scene].push_back(bookmarkFrom(bookmark));
        }
    }
    read("picture_width", settings.pictureWidth_px);
    read("picture_height", settings.pictureHeight_px);
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
    settings.pictureWidth_px = std::clamp(settings.pictureWidth_px, -1, 16384);
    settings.pictureHeight_px = std::clamp(settings.pictureHeight_px, -1, 16384);
    settings.recentFiles.resize(std::min(settings.recentFiles.size(), maxRecent));
    return settings;
}

}  // namespace

void Settings::addRecent(const RecentFile& file) {
    std::erase(recentFiles, file);
    recentFiles.insert(recentFiles.begin(), file);
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
                 {"recent_files", Json::array()},
                 {"bookmarks", Json::object()},
                 {"picture_width", settings.pictureWidth_px},
                 {"picture_height", settings.pictureHeight_px},
                 {"parameters", Json::object()},
                 {"presets", Json::object()},
                 {"seen_help", settings.seenHelp}};
    for (const RecentFile& recent : settings.recentFiles) json["recent_files"].push_back(toJson(recent));
    for (const auto& [scene, bookmarks] : settings.bookmarks) {
        for (const Bookmark& bookmark : bookmarks) json["bookmarks"][scene].push_back(toJson(bookmark));
    }
    for (const auto& [name, values] : settings.parameters) json["parameters"][name] = toJson(values);
    for (const auto& [technique, presets] : settings.presets) {
        for (const auto& [name, values] : presets) json["presets"][technique][name] = toJson(values);
    }
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    writeFileAtomically(file, json.dump(2) + "\n");
}

}  // namespace penumbra::studio::viewer
