// SPDX-License-Identifier: Apache-2.0
// The one door to scenes: a built-in by name, or a glTF file with the lights that lie beside it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "studio/scene/light_size.h"
#include "studio/scene/model_reading.h"
#include "studio/scene/scene.h"
#include "studio/scene/sun/sun.h"

namespace penumbra::studio {

/// The sun of `--sun`.
struct SunOption {
    std::string text;  ///< LAT,LON,ISO-TIME as it was given
    SunPlace place;
    SunSetting setting;
};

struct OpenOptions {
    /// Lights from this file (see docs/lights.md) instead of from SCENE.lights.json beside the scene.
    std::optional<std::filesystem::path> lightsFile;
    std::optional<SunOption> sun;
    /// Which animations play together; none: the rest pose. Unset: all that move different things.
    std::optional<std::vector<int>> animations;
    std::optional<int> scene;  ///< which of a glTF file's scenes; the file's own default where unset
    ModelReading reading;      ///< of a file; what is not said here its file of lights may say
    LightSizes lightSizes;     ///< for lights that have none
};

/// Opens a built-in scene of this name, or else the .gltf or .glb file (`./NAME` for a file named like a
/// built-in).
///
/// Its lights are those of `lightsFile`, else of the sidecar (chair.lights.json beside chair.glb) if there is
/// one, else its own. The sun is added to those of a file; the scene's own it replaces. A scene that has none
/// gets a key light over it, and one without a camera gets one (defaultCamera); both are said in
/// Scene::warnings, as are doubts about unit and axes, and lights that have no size.
///
/// Throws InputError, which names the file and the remedy, for whatever is missing or wrong.
Scene openScene(const std::string& nameOrPath, const OpenOptions& options = {});

}  // namespace penumbra::studio
