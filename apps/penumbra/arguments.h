// SPDX-License-Identifier: Apache-2.0
// What several subcommands take.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "studio/bench/contest.h"
#include "studio/image/image.h"
#include "studio/scene/open_scene.h"
#include "studio/workbench/workbench.h"

namespace penumbra::studio {

/// --sun and how the scene lies in it.
struct SunArguments {
    std::optional<std::string> place;
    double north_deg = 0;
    bool noRefraction = false;

    void addTo(CLI::App& command);
    /// Throws InputError for what is no place or time.
    std::optional<SunOption> option() const;
};

/// SCENE and how to look at it.
struct SceneArguments {
    std::string scene;
    std::optional<std::string> lightsFile;
    SunArguments sun;
    std::optional<std::string> camera;
    std::optional<std::string> lookFrom, lookAt;
    float fov_deg = 40;
    std::optional<float> orthoHeight_m;
    std::optional<int> sceneIndex;
    std::optional<std::string> glass, unit, up;  ///< unset: as the file of lights says
    float lightRadius_m = 0, sunAngle_deg = 0;
    std::vector<int> animations;  ///< empty: not asked for; {-1}: none
    double time_s = 0;
    std::string size = "960x540";
    std::optional<int> device;

    /// Adds SCENE and the flags to a subcommand.
    void addTo(CLI::App& command);
    /// The flags alone, for subcommands that take several scenes.
    void addFlagsTo(CLI::App& command);
    /// SCENE, --lights, --scene and --animation alone.
    void addSceneTo(CLI::App& command, bool required = true);
    /// Camera and moment alone.
    void addCameraTo(CLI::App& command);

    OpenOptions openOptions() const;
    /// Opens the scene and logs its warnings. Throws InputError.
    Scene open() const;
    /// The camera that --camera names or --look-from places; the scene's first without either. Throws
    /// UsageError.
    Camera cameraIn(const Scene& opened, const SceneMoment& moment) const;
    /// Throws UsageError unless --size is WIDTHxHEIGHT.
    PictureSize pictureSize() const;
};

/// A scene on a workbench, ready to be rendered: what `compare` and `bench` start from.
struct OpenedScene {
    /// Throws UsageError, InputError or NoOpenGLError.
    explicit OpenedScene(const SceneArguments& arguments);

    PictureSize size;
    Scene scene;
    SceneMoment moment;
    Camera camera;  ///< of `moment`, or placed by --look-from
    Workbench workbench;
};

/// A technique as -t names it: NAME, or NAME:KEY=VALUE:KEY=VALUE. Throws UsageError with the nearest name.
Contender parseTechnique(const std::string& text);

/// What -t names, one or several with commas between, or "all": the library's catalog, without the reference.
/// On top come the --set: "KEY=VALUE" for all of them, "NAME.KEY=VALUE" for those of one technique. Throws
/// UsageError.
std::vector<Contender> parseContenders(const std::string& list, const std::vector<std::string>& settings);

/// A --set: "KEY=VALUE", or "NAME.KEY=VALUE" for one technique.
struct Setting {
    std::string technique;  ///< empty: whichever is in use
    std::string key, value;
};
/// Throws UsageError.
Setting parseSetting(const std::string& text);

/// Finite numbers from `low` to `high`, for options; `unit` is for the message.
CLI::Validator finiteWithin(double low, double high, const std::string& unit);

/// What every picture carries.
Metadata pictureMetadata(const std::string& commandLine);

/// Throws OutputError unless files can be made in `folder`; creates it first if `create`.
void requireWritableFolder(const std::filesystem::path& folder, bool create = false);

}  // namespace penumbra::studio
