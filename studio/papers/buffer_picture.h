// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "penumbra/technique.h"
#include "studio/image/image.h"

namespace penumbra::studio {

/// The first layer of the intermediate buffer of the last render whose name contains `name`, as a picture of
/// the shape of `shape`: of a buffer of another shape, which is one of the light's, the part that holds
/// anything. What is 0 stays black, and all other values are stretched over what the eye can tell apart.
/// Nothing if there is no such buffer.
std::optional<Image> bufferPicture(const Technique& technique, std::string_view name, PictureSize shape);

}  // namespace penumbra::studio
