// SPDX-License-Identifier: Apache-2.0
// Recipes' situations as scenes.
#pragma once

#include <filesystem>
#include <string>

#include "studio/papers/recipe.h"
#include "studio/scene/scene.h"

namespace penumbra::studio {

/// A situation, ready to be opened. Address-stable: keep it where it is while a workbench has it open.
struct Stage {
    Scene scene;
    std::string standIn;  ///< the built-in scene that stands in for a model that is not there; else empty
};

/// The scene of a situation: its model over a ground, if `models` has it, or its built-in scene. Grounds only
/// receive, as the papers' do: what they publish draws none into its maps. Throws InputError for a model that
/// cannot be read.
Stage openStage(const Situation& situation, const std::filesystem::path& models);

/// The moment and camera that a situation asks of its scene.
struct StageView {
    SceneMoment moment;
    Camera camera;
};
StageView viewOf(const Stage& stage, const Situation& situation);

}  // namespace penumbra::studio
