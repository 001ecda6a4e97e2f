// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "studio/scene/scene.h"

namespace penumbra::studio {

/// Gives a scene the light and the camera that it lacks: a key light over it, and a camera that sees
/// something (defaultCamera). Scene::warnings says so, under `nameForMessages`.
void addDefaults(Scene& scene, const std::string& nameForMessages);

}  // namespace penumbra::studio
