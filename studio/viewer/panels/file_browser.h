// SPDX-License-Identifier: Apache-2.0
// A window to choose a file in: a path that can be typed, and what lies in its folder to click on.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "studio/viewer/panels/ui.h"

namespace penumbra::studio::viewer {

class FileBrowser {
  public:
    enum class Wanted { scene, lightsToSave, grid, profile, texture };

    /// Shows it from now on. `start` stands in the path's field; a folder, with a separator at its end, is
    /// looked into.
    void open(Wanted wanted, const std::filesystem::path& start);
    bool isOpen() const { return wanted_.has_value(); }

    /// Once a frame: puts what was chosen into the requests.
    void draw(Ui& ui, Requests& requests);

  private:
    struct Entry {
        std::string name;
        bool isFolder = false;
    };
    void look();
    void take(const std::string& path, Requests& requests);
    /// Draws what lies in the folder; whether a file was clicked.
    bool drawEntries(Ui& ui);

    std::optional<Wanted> wanted_;
    bool isNew_ = false;
    std::string path_;  ///< as typed
    std::filesystem::path folder_;
    std::vector<Entry> entries_;  ///< of the folder, folders first
    std::string problem_;
};

}  // namespace penumbra::studio::viewer
