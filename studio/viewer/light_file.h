// SPDX-License-Identifier: Apache-2.0
// The file that a scene's lights were read from, and what it becomes where some of them are others: what was
// not changed stays letter for letter.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "studio/scene/lights/sidecar.h"

namespace penumbra::studio::viewer {

/// A light to be written.
struct WrittenLight {
    /// As it stands in the file that was read.
    std::optional<std::size_t> own;
    /// As it would be written: `now`, where it was edited, and what the file's would have been before. Their
    /// parents are the same. Neither: as it stands in the file.
    std::optional<SidecarLight> was, now;
};

/// A light as a file states it, in the world's space and without the names of the files that it needs.
SidecarLight stated(const Light& light);

class LightFile {
  public:
    /// Nothing to keep where there is no such file. Throws InputError where it is none of lights.
    explicit LightFile(const std::filesystem::path& file);

    /// Those that the file lists.
    const std::vector<SidecarLight>& lights() const { return lights_; }

    /// A file with these lights, and all others that it names.
    struct Written {
        std::string text;
        std::vector<std::pair<std::string, std::string>> files;  ///< name and content
        std::vector<std::pair<std::string, Image>> pictures;     ///< by name, to be written as PNG
    };
    /// `stem` begins the names of files that are new. `beside`: it will lie where the old file does, whose
    /// neighbours it finds there.
    Written with(const Scene& scene, std::vector<WrittenLight> lights, const std::string& stem,
                 bool beside) const;

    bool liesIn(const std::filesystem::path& folder) const;

  private:
    std::string elementOf(const WrittenLight& light) const;

    std::filesystem::path folder_;
    std::string text_;
    std::vector<SidecarLight> lights_;
    std::vector<std::string> elements_;  ///< the text of each
};

/// Writes all of it, the file of lights last.
void write(const LightFile::Written& written, const std::filesystem::path& file);

}  // namespace penumbra::studio::viewer
