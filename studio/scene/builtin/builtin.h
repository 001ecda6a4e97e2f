// SPDX-License-Identifier: Apache-2.0
// Scenes that need no file: the papers' figures, set-ups whose shadow is known in closed form, and a few that
// show off.
#pragma once

#include <span>
#include <string_view>

#include "studio/scene/scene.h"

namespace penumbra::studio {

struct BuiltinInfo {
    std::string_view name;     ///< as on the command line: "primitives"
    std::string_view summary;  ///< one line; of the closed-form scenes it states the geometry
};

/// All of them, in the order in which they are listed.
std::span<const BuiltinInfo> builtinScenes();

/// Whether there is a built-in scene of this name.
bool isBuiltin(std::string_view name);

/// The index of a built-in scene's ground or room among its nodes.
inline constexpr int groundNode = 0;

/// Makes the scene of this name. Throws InputError with the nearest names if there is none.
///
/// In metres, +Y up, the ground at y = 0. Of the closed-form scenes every
/// blocker is a sheet without thickness; the blockers of the others are closed, but for the cloth and the
/// lamp's shade.
Scene makeBuiltin(std::string_view name);

}  // namespace penumbra::studio
