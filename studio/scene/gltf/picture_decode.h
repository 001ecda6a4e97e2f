// SPDX-License-Identifier: Apache-2.0
// PNG and JPEG from bytes that nobody vouches for.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "studio/image/image.h"
#include "studio/scene/scene.h"

namespace penumbra::studio {

/// Reads the header only. Throws InputError, naming the picture, where it is neither PNG nor JPEG, is
/// damaged, or is larger than 16384 pixels a side or 2^27 pixels in all.
PictureSize readPictureSize(std::span<const std::byte> bytes, const std::string& nameForMessages);

/// Decodes a PNG (palette, grey, 16-bit: all become RGBA8; embedded colour spaces are ignored, as glTF
/// demands) or a JPEG (not CMYK). Picture::name is `nameForMessages`. Throws InputError as above, and where
/// any pixel is missing.
Picture decodePicture(std::span<const std::byte> bytes, const std::string& nameForMessages);

}  // namespace penumbra::studio
