// SPDX-License-Identifier: Apache-2.0
// What survives a restart, in the platform's own place.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "studio/viewer/technique_bank.h"

namespace penumbra::studio::viewer {

struct Settings {
    int width = 1280, height = 800;  ///< of the window
    float resolutionScale = 0;       ///< 0: what suits the device
    int referenceSamples = 1024;
    bool referenceRuns = true;
    std::string technique;  ///< empty: the default
    std::string other = "reference";
    std::vector<std::string> recentFiles;               ///< the newest first, at most ten
    std::map<std::string, ParameterValues> parameters;  ///< by technique, what is not default
    std::map<std::string, std::map<std::string, ParameterValues>> presets;  ///< by technique and name
    bool seenHelp = false;

    void addRecent(const std::string& path);
};

/// $XDG_CONFIG_HOME/penumbra/viewer.json, else beneath ~/.config.
std::filesystem::path settingsFile();
/// $XDG_DATA_HOME/penumbra, else beneath ~/.local/share: files that commands refer to.
std::filesystem::path dataFolder();

/// The defaults where the file does not exist or cannot be understood, which is logged and no more: an
/// unreadable settings file must not keep anyone from looking at a scene.
Settings loadSettings(const std::filesystem::path& file);
/// Throws OutputError.
void saveSettings(const Settings& settings, const std::filesystem::path& file);

}  // namespace penumbra::studio::viewer
