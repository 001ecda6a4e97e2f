// SPDX-License-Identifier: Apache-2.0
// libpng's reader with its errors as results: it reports them by longjmp, which must not skip a destructor.
#pragma once

#include <png.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "studio/image/image.h"

namespace penumbra::studio {

/// Whether the bytes begin as a PNG does.
bool isPng(std::span<const std::byte> bytes);

/// Reads one picture, whatever its bit depth, palette and interlacing. `bytes` must outlive it.
class PngReader {
  public:
    explicit PngReader(std::span<const std::byte> bytes);
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;
    ~PngReader();

    /// What was wrong where a call returned false.
    const char* message() const { return message_.data(); }

    bool readHeader(std::uint32_t& width, std::uint32_t& height);
    /// After readHeader(); `rows` are the starts of the picture's rows, four bytes a pixel: RGBA.
    bool readPixels(png_bytepp rows);

    /// Of the file: 1 (grey), 3 or 4. After readHeader().
    int channels() const;
    /// The text chunks. After readPixels().
    Metadata texts() const;

  private:
    static void take(png_structp png, png_bytep out, std::size_t count);
    [[noreturn]] static void onError(png_structp png, png_const_charp text);

    std::span<const std::byte> rest_;
    std::array<char, 200> message_{};
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

}  // namespace penumbra::studio
