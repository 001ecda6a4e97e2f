// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <csetjmp>
#include <cstring>

#include "studio/errors.h"
#include "studio/image/atomic_file.h"
#include "studio/image/image_io.h"

// libpng reports errors by longjmp. A jump over a C++ object that has a destructor is undefined, hence the
// functions that call setjmp own nothing: whatever needs freeing belongs to their caller.
namespace penumbra::studio {
namespace {

struct Failure {
    std::array<char, 200> message{};
};

[[noreturn]] void onError(png_structp png, png_const_charp message) {
    auto* failure = static_cast<Failure*>(png_get_error_ptr(png));
    std::strncpy(failure->message.data(), message, failure->message.size() - 1);
    png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

class Writer {
  public:
    Writer() : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, &failure, onError, onWarning)) {
        info_ = png_ ? png_create_info_struct(png_) : nullptr;
        if (!info_) std::strncpy(failure.message.data(), "out of memory", failure.message.size() - 1);
    }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
    ~Writer() { png_destroy_write_struct(&png_, &info_); }

    /// False, and `failure` says why, when libpng refuses.
    bool write(const png_byte* pixels, int width, int height, int channels, std::span<png_text> texts) {
        if (!info_) return false;
        if (setjmp(png_jmpbuf(png_))) return false;
        png_set_write_fn(png_, &bytes, append, nullptr);
        const int colorType = channels == 1   ? PNG_COLOR_TYPE_GRAY
                              : channels == 3 ? PNG_COLOR_TYPE_RGB
                                              : PNG_COLOR_TYPE_RGB_ALPHA;
        png_set_IHDR(png_, info_, png_uint_32(width), png_uint_32(height), 8, colorType, PNG_INTERLACE_NONE,
                     PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        png_set_sRGB(png_, info_, PNG_sRGB_INTENT_PERCEPTUAL);
        png_set_text(png_, info_, texts.data(), int(texts.size()));
        png_write_info(png_, info_);
        for (int y = 0; y < height; ++y) png_write_row(png_, pixels + std::size_t(y) * width * channels);
        png_write_end(png_, info_);
        return true;
    }

    std::vector<std::byte> bytes;
    Failure failure;

  private:
    static void append(png_structp png, png_bytep data, std::size_t size) {
        auto& bytes = *static_cast<std::vector<std::byte>*>(png_get_io_ptr(png));
        const auto* first = reinterpret_cast<const std::byte*>(data);
        bytes.insert(bytes.end(), first, first + size);
    }

    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

std::vector<png_byte> quantize(const std::filesystem::path& path, const Image& image) {
    std::vector<png_byte> pixels(image.values.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const float value = image.values[i];
        if (!std::isfinite(value)) {
            const std::size_t pixel = i / std::size_t(image.channels);
            throw OutputError(fmt::format("cannot write '{}': pixel ({}, {}) is {}; an EXR file can hold it",
                                          path.string(), pixel % image.width_px, pixel / image.width_px,
                                          value));
        }
        pixels[i] = png_byte(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
    }
    return pixels;
}

std::vector<png_text> textChunks(const std::filesystem::path& path, const Metadata& metadata) {
    std::vector<png_text> chunks;
    for (const auto& [key, value] : metadata) {
        const bool printable = std::ranges::all_of(key, [](char c) { return c >= ' ' && c <= '~'; });
        if (key.empty() || key.size() > 79 || !printable) {
            throw OutputError(fmt::format(
                "cannot write '{}': '{}' is no PNG keyword; use 1 to 79 printable ASCII characters",
                path.string(), key));
        }
        const bool ascii =
            std::ranges::all_of(value, [](char c) { return (c >= ' ' && c <= '~') || c == '\n'; });
        png_text chunk{};
        chunk.compression = ascii ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
        chunk.key = const_cast<char*>(key.c_str());
        chunk.text = const_cast<char*>(value.c_str());
        chunk.text_length = ascii ? value.size() : 0;
        chunk.itxt_length = ascii ? 0 : value.size();
        chunks.push_back(chunk);
    }
    return chunks;
}

/// `path` is what messages name.
std::vector<std::byte> encode(const std::filesystem::path& path, const Image& image,
                              const Metadata& metadata) {
    assert(image.channels == 1 || image.channels == 3 || image.channels == 4);
    const std::vector<png_byte> pixels = quantize(path, image);
    std::vector<png_text> texts = textChunks(path, metadata);
    Writer writer;
    if (!writer.write(pixels.data(), image.width_px, image.height_px, image.channels, texts)) {
        throw OutputError(fmt::format("cannot write '{}': {}; choose another size or format", path.string(),
                                      writer.failure.message.data()));
    }
    return std::move(writer.bytes);
}

}  // namespace

void writePng(const std::filesystem::path& path, const Image& image, const Metadata& metadata) {
    writeFileAtomically(path, encode(path, image, metadata));
}

std::vector<std::byte> encodePng(const Image& image) {
    return encode("a picture in a page", image, {});
}

}  // namespace penumbra::studio
