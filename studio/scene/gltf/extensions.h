// SPDX-License-Identifier: Apache-2.0
// Which extensions are read, which a file may do without, and what that means for light and shadow.
#pragma once

#include <string>

#include "studio/scene/gltf/json_view.h"
#include "studio/scene/scene.h"

namespace penumbra::studio::gltf {

/// Throws PlaceError where the file requires an extension without which its shapes cannot be told. What is
/// left out without harm to them goes to scene.warnings, a line each.
void checkExtensions(const JsonView& root, Scene& scene);

}  // namespace penumbra::studio::gltf
