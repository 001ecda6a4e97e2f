// SPDX-License-Identifier: Apache-2.0
// Which extensions are read, which a file may do without, and what that means for light and shadow.
#pragma once

#include <optional>
#include <string_view>

#include "studio/scene/gltf/place_error.h"
#include "studio/scene/scene.h"

namespace penumbra::studio::gltf {

/// Throws PlaceError where the file requires an extension without which its shapes cannot be told. What is
/// left out without harm to them goes to scene.warnings, a line each.
void checkExtensions(const JsonView& root, Scene& scene);

/// `extensions.NAME` of an object, where present.
std::optional<JsonView> extensionOf(const JsonView& object, std::string_view name);

/// `extras.penumbra`, where present. Extras that are not an object are somebody else's.
std::optional<JsonView> penumbraExtrasOf(const JsonView& object);

}  // namespace penumbra::studio::gltf
