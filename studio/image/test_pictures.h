// SPDX-License-Identifier: Apache-2.0
// Pictures for tests, encoded by the libraries' own writers.
#pragma once

#include <png.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

// After <cstdio>, which jpeglib.h needs.
#include <jpeglib.h>

namespace penumbra::studio {

/// `rows` are packed as PNG packs them. Palette pictures get the palette red, green (half transparent), blue.
inline std::string encodedPng(int width, int height, int bitDepth, int colorType,
                              std::vector<std::uint8_t> rows, double gamma = 0) {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    std::string out;
    const auto write = [](png_structp self, png_bytep bytes, png_size_t count) {
        static_cast<std::string*>(png_get_io_ptr(self))->append(reinterpret_cast<const char*>(bytes), count);
    };
    png_set_write_fn(png, &out, write, [](png_structp) {});
    png_set_IHDR(png, info, png_uint_32(width), png_uint_32(height), bitDepth, colorType, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    const png_color palette[] = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}};
    const png_byte alphas[] = {255, 128};
    if (colorType == PNG_COLOR_TYPE_PALETTE) {
        png_set_PLTE(png, info, palette, 3);
        png_set_tRNS(png, info, alphas, 2, nullptr);
    }
    if (gamma > 0) png_set_gAMA(png, info, gamma);
    png_write_info(png, info);
    const std::size_t rowBytes = png_get_rowbytes(png, info);
    for (int y = 0; y < height; ++y) png_write_row(png, &rows[std::size_t(y) * rowBytes]);
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    return out;
}

/// A grey PNG of one pixel whose header claims another size, with the checksum that libpng would miss first.
inline std::string pngThatClaims(std::uint32_t width, std::uint32_t height) {
    std::string bytes = encodedPng(1, 1, 8, PNG_COLOR_TYPE_GRAY, {0});
    for (int i = 0; i < 4; ++i) {
        bytes[std::size_t(16 + i)] = char(width >> (24 - 8 * i));
        bytes[std::size_t(20 + i)] = char(height >> (24 - 8 * i));
    }
    std::uint32_t crc = 0xffffffff;
    for (std::size_t i = 12; i < 29; ++i) {
        crc ^= std::uint8_t(bytes[i]);
        for (int k = 0; k < 8; ++k) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0u);
    }
    crc = ~crc;
    for (int i = 0; i < 4; ++i) bytes[std::size_t(29 + i)] = char(crc >> (24 - 8 * i));
    return bytes;
}

/// One colour all over: three components RGB, one grey, four CMYK.
inline std::string encodedJpeg(int width, int height, std::vector<std::uint8_t> color) {
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &bytes, &size);
    jpeg.image_width = JDIMENSION(width);
    jpeg.image_height = JDIMENSION(height);
    jpeg.input_components = int(color.size());
    jpeg.in_color_space = color.size() == 1 ? JCS_GRAYSCALE : color.size() == 3 ? JCS_RGB : JCS_CMYK;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, 100, TRUE);
    jpeg_start_compress(&jpeg, TRUE);
    std::vector<std::uint8_t> row;
    for (int x = 0; x < width; ++x) row.insert(row.end(), color.begin(), color.end());
    JSAMPROW rows[] = {row.data()};
    while (jpeg.next_scanline < jpeg.image_height) jpeg_write_scanlines(&jpeg, rows, 1);
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    std::string out(reinterpret_cast<char*>(bytes), size);
    std::free(bytes);
    return out;
}

}  // namespace penumbra::studio
