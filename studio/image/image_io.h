// SPDX-License-Identifier: Apache-2.0
// Pictures in files. Every writer's file appears whole or not at all (see atomic_file.h).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "studio/image/image.h"

namespace penumbra::studio {

/// One channel of an EXR file: "V", "key.V", "key.V.R", "R", ...
struct ExrChannel {
    std::string name;
    std::vector<float> values;  ///< row by row from the top, width_px * height_px
};

/// What an EXR file holds. Channel names are unique and not empty.
struct ExrPicture {
    int width_px = 0, height_px = 0;
    std::vector<ExrChannel> channels;
    Metadata metadata;  ///< text attributes
};

/// The channels of `image`: one channel is called `name`; three or four are called R, G, B, A, after `name`
/// and a dot where `name` is not empty. So channelsOf(v, "key.V") gives "key.V", or "key.V.R", "key.V.G",
/// "key.V.B".
std::vector<ExrChannel> channelsOf(const Image& image, std::string_view name);

/// The channels named as channelsOf() names them, as one image: of one channel if there is one called `name`,
/// else of three, or four if there is an A. Throws InputError if they are not there.
Image imageOf(const ExrPicture& picture, std::string_view name);

/// Writes 32-bit floats, ZIP-compressed, bit for bit; any value is legal. Throws OutputError. Metadata whose
/// key EXR keeps for itself ("channels", "compression", ...) is an OutputError too.
void writeExr(const std::filesystem::path& path, const ExrPicture& picture);

/// Reads any scan-line or tiled EXR of at most 2^27 pixels; half and integer channels are converted to float,
/// and sub-sampled ones are an error. Throws InputError.
ExrPicture readExr(const std::filesystem::path& path);

/// Writes eight bits a channel: grey (1 channel), RGB (3) or RGBA (4), values as they shall be shown
/// (sRGB-encoded), clamped to [0, 1] and rounded. A value that is not finite is an OutputError that names its
/// pixel. Metadata is stored as text chunks, its keys being 1 to 79 printable ASCII characters.
void writePng(const std::filesystem::path& path, const Image& image, const Metadata& metadata = {});

/// The bytes of such a file, without metadata: for pages that hold their pictures.
std::vector<std::byte> encodePng(const Image& image);

struct PngPicture {
    Image image;  ///< sRGB-encoded as stored, in [0, 1]; 1 (grey), 3 or 4 channels
    Metadata metadata;
};

/// Reads a PNG file of at most 2^27 pixels, with whatever bit depth and palette. Throws InputError.
PngPicture readPng(const std::filesystem::path& path);

}  // namespace penumbra::studio
