// SPDX-License-Identifier: Apache-2.0
// What leaves the viewer: pictures, and the command that makes them again.
#pragma once

#include <filesystem>
#include <string>

#include "studio/viewer/session.h"

namespace penumbra::studio::viewer {

/// The `penumbra render` line that makes side A's picture without a window, pixel for pixel on the same
/// device. Edited lights are written to a file beneath `folder`, which the line names.
std::string renderCommand(Session& session, const std::filesystem::path& folder, PictureSize size);

/// Side A's picture: .png as shown, .exr in nits. Its metadata hold `command` and the viewer's choices.
/// Throws UsageError for other extensions and OutputError.
void savePicture(const Session& session, const Session::KeptPicture& picture,
                 const std::filesystem::path& file, const std::string& command);
/// The canvas as it is shown, false colours and all, as PNG.
void saveCanvas(const Session& session, const std::filesystem::path& file, const std::string& command);

/// Frames of the animation, one after another, into numbered PNG files.
class Recorder {
  public:
    struct Plan {
        std::filesystem::path folder;
        int first = 0, last = 0;
        double framesPerSecond = 24;
    };
    /// Throws UsageError for a range that is empty, and OutputError if the folder cannot be written.
    void start(const Plan& plan);
    void stop() { active_ = false; }
    bool active() const { return active_; }
    double fraction() const;
    /// The moment that has to be shown for the next frame.
    double time_s() const { return next_ / plan_.framesPerSecond; }
    /// Writes what is shown as the next frame and goes on. Throws OutputError, and then is no longer active.
    void write(Session& session, const std::string& command);

    const Plan& plan() const { return plan_; }

  private:
    Plan plan_;
    int next_ = 0;
    bool active_ = false;
};

}  // namespace penumbra::studio::viewer
