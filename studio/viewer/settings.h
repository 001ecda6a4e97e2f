// SPDX-License-Identifier: Apache-2.0
// What survives a restart, in the platform's own place.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "studio/scene/look_at.h"
#include "studio/viewer/technique_bank.h"

namespace penumbra::studio::viewer {

/// A scene that was open: a built-in one's name, or the absolute path of a file.
struct RecentFile {
    std::string scene;
    std::string lights;  ///< the file that its lights were of, absolute; empty: its own
    bool operator==(const RecentFile&) const = default;
};

/// A view that was kept.
struct Bookmark {
    std::string name;
    LookAt look;
    bool operator==(const Bookmark& with) const {
        return name == with.name && look.eye == with.look.eye && look.target == with.look.target &&
               look.fov_deg == with.look.fov_deg && look.height_m == with.look.height_m;
    }
};

struct Settings {
    int width = 1280, height = 800;  ///< of the window
    float resolutionScale = 0;       ///< 0: what suits the device
    int referenceSamples = 1024;
    bool referenceRuns = true;
    std::string technique;  ///< empty: the default
    std::string other = "reference";
    std::vector<RecentFile> recentFiles;                ///< the newest first, at most ten
    std::map<std::string, ParameterValues> parameters;  ///< by technique, what is not default
    std::map<std::string, std::map<std::string, ParameterValues>> presets;  ///< by technique and name
    std::map<std::string, std::vector<Bookmark>> bookmarks;  ///< by scene, as RecentFile names it
    /// Of pictures that are saved, and that commands render; 0: the window's full size, -1: as it is shown.
    int pictureWidth_px = 0, pictureHeight_px = 0;
    bool seenHelp = false;

    void addRecent(const RecentFile& file);
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
