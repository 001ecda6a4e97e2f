// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "studio/errors.h"
#include "studio/image/atomic_file.h"
#include "studio/image/image_io.h"
#include "studio/image/png_reader.h"

namespace penumbra::studio {

PngPicture readPng(const std::filesystem::path& path) {
    constexpr std::uint64_t maxPixels = 1u << 27;
    const std::vector<std::byte> file = readWholeFile(path);
    const auto refuse = [&](std::string_view problem) {
        throw InputError(
            fmt::format("cannot read '{}' as a PNG picture: {}; write it again", path.string(), problem));
    };
    PngReader reader(file);
    std::uint32_t width = 0, height = 0;
    if (!reader.readHeader(width, height)) refuse(reader.message());
    if (std::uint64_t(width) * height > maxPixels) refuse("it is too large");
    const int channels = reader.channels();

    constexpr std::size_t read = 4;  // RGBA
    std::vector<std::uint8_t> pixels(std::size_t(width) * height * read);
    std::vector<std::uint8_t*> rows(height);
    for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = &pixels[y * width * read];
    if (!reader.readPixels(rows.data())) refuse(reader.message());

    PngPicture picture{.image = Image(int(width), int(height), channels), .metadata = reader.texts()};
    for (std::size_t i = 0; i < picture.image.values.size(); ++i) {
        const std::size_t pixel = i / std::size_t(channels), channel = i % std::size_t(channels);
        picture.image.values[i] = float(pixels[pixel * read + channel]) / 255.0f;
    }
    return picture;
}

}  // namespace penumbra::studio
