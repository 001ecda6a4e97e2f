// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "studio/scene/scene.h"

namespace penumbra::studio {

/// The way to a glTF file from one of another kind, by its name: a program that converts it, and its command.
/// Empty where none is known.
std::string wayToGltf(const std::filesystem::path& file);

/// What makes one doubt that a file is in metres and has Y up, and the flag that says so; nothing where all
/// is well. `moment` is read as glTF demands.
std::optional<std::string> unitHint(const SceneMoment& moment);
std::optional<std::string> upHint(const Scene& scene, const SceneMoment& moment);

}  // namespace penumbra::studio
