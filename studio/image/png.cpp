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

constexpr std::size_t maxPixels = std::size_t(1) << 27;

struct Failure {
    std::array<char, 200> message{};
};

[[noreturn]] void onError(png_structp png, png_const_charp message) {
    auto* failure = static_cast<Failure*>(png_get_error_ptr(png));
    std::strncpy(failure->message.data(), message, failure->message.size() - 1);
    png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

// --- Writing ---

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

// --- Reading ---

class Reader {
  public:
    explicit Reader(std::span<const std::byte> file)
        : rest_(file), png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &failure, onError, onWarning)) {
        info_ = png_ ? png_create_info_struct(png_) : nullptr;
        if (!info_) std::strncpy(failure.message.data(), "out of memory", failure.message.size() - 1);
    }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }

    /// False, and `failure` says why, when libpng refuses. Then `channels`, `width` and `height` are known.
    bool readHeader() {
        if (!info_) return false;
        if (setjmp(png_jmpbuf(png_))) return false;
        png_set_user_limits(png_, 1 << 16, 1 << 16);
        png_set_read_fn(png_, this, take);
        png_read_info(png_, info_);
        png_set_expand(png_);
        png_set_scale_16(png_);
        passes_ = png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
        if (png_get_channels(png_, info_) == 2) png_error(png_, "grey with alpha is not supported");
        channels = png_get_channels(png_, info_);
        width = png_get_image_width(png_, info_);
        height = png_get_image_height(png_, info_);
        if (std::size_t(width) * height > maxPixels) png_error(png_, "it is too large");
        return true;
    }

    /// Fills width * height * channels bytes.
    bool readPixels(png_byte* pixels) {
        if (setjmp(png_jmpbuf(png_))) return false;
        const std::size_t stride = std::size_t(width) * channels;
        for (int pass = 0; pass < passes_; ++pass) {
            for (std::size_t y = 0; y < height; ++y) png_read_row(png_, pixels + y * stride, nullptr);
        }
        png_read_end(png_, info_);
        return true;
    }

    Metadata texts() const {
        Metadata metadata;
        png_textp chunks = nullptr;
        const int count = png_get_text(png_, info_, &chunks, nullptr);
        for (int i = 0; i < count; ++i) metadata[chunks[i].key] = chunks[i].text;
        return metadata;
    }

    png_uint_32 width = 0, height = 0;
    int channels = 0;
    Failure failure;

  private:
    static void take(png_structp png, png_bytep destination, std::size_t size) {
        auto& rest = static_cast<Reader*>(png_get_io_ptr(png))->rest_;
        if (size > rest.size()) png_error(png, "the file ends too early");
        std::memcpy(destination, rest.data(), size);
        rest = rest.subspan(size);
    }

    std::span<const std::byte> rest_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
    int passes_ = 1;
};

}  // namespace

namespace {

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

PngPicture readPng(const std::filesystem::path& path) {
    const std::vector<std::byte> file = readWholeFile(path);
    const auto refuse = [&](const Failure& failure) {
        return InputError(fmt::format("cannot read '{}' as a PNG picture: {}; write it again", path.string(),
                                      failure.message.data()));
    };
    Reader reader(file);
    if (!reader.readHeader()) throw refuse(reader.failure);
    std::vector<png_byte> pixels(std::size_t(reader.width) * reader.height * reader.channels);
    if (!reader.readPixels(pixels.data())) throw refuse(reader.failure);

    PngPicture picture{.image = Image(int(reader.width), int(reader.height), reader.channels)};
    std::ranges::transform(pixels, picture.image.values.begin(),
                           [](png_byte value) { return float(value) / 255.0f; });
    picture.metadata = reader.texts();
    return picture;
}

}  // namespace penumbra::studio
