// SPDX-License-Identifier: Apache-2.0
// PNG, JPEG and WebP from bytes that nobody vouches for.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "studio/errors.h"
#include "studio/image/image.h"

namespace penumbra::studio {

/// A picture that is no harm, but cannot be read: damaged, or of a kind that is not known here.
struct UnreadablePicture : InputError {
    using InputError::InputError;
};

/// Reads the header only. Throws InputError, naming the picture: UnreadablePicture where it is none of them
/// or is damaged, another where it is larger than 16384 pixels a side or 2^27 pixels in all.
PictureSize readPictureSize(std::span<const std::byte> bytes, const std::string& nameForMessages);

/// Decodes a PNG (palette, grey, 16-bit: all become RGBA8; embedded colour spaces are ignored, as glTF
/// demands), a JPEG (not CMYK) or a WebP that does not move. Picture::name is `nameForMessages`. Throws
/// InputError as above, and where any pixel is missing.
Picture decodePicture(std::span<const std::byte> bytes, const std::string& nameForMessages);

}  // namespace penumbra::studio
