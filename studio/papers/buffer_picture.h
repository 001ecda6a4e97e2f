// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "penumbra/technique.h"
#include "studio/image/image.h"

namespace penumbra::studio {

/// The first layer of the intermediate buffer of the last render whose name contains `name`, as a picture:
/// what is 0 stays black, and all other values are stretched over what the eye can tell apart. Nothing if
/// there is none.
std::optional<Image> bufferPicture(const Technique& technique, std::string_view name);

}  // namespace penumbra::studio
