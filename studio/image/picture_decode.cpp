// SPDX-License-Identifier: Apache-2.0
//
// libjpeg reports errors by longjmp, which must not skip a destructor: the functions that call setjmp have
// trivial locals only, and what they fill belongs to their callers.
#include "studio/image/picture_decode.h"

#include <fmt/format.h>
#include <webp/decode.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <cstring>

// After <cstdio>, which jpeglib.h needs.
#include <jerror.h>
#include <jpeglib.h>

#include "studio/errors.h"
#include "studio/image/png_reader.h"

namespace penumbra::studio {

namespace {

constexpr std::uint32_t maxSide_px = 16384;
constexpr std::uint64_t maxPixels = 1u << 27;

// A picture this much larger than its file is a decompression bomb, once it is large enough to matter.
constexpr std::uint64_t maxExpansion = 1000, harmless_bytes = 16u << 20;

// Far more than encoders write; each further scan of a progressive JPEG costs as much as the whole picture.
constexpr int maxScans = 200;

struct Message {
    std::array<char, JMSG_LENGTH_MAX> text{};
};

std::string refusal(const std::string& name, const std::string& problem) {
    return fmt::format("picture '{}' {}; save it again as PNG, JPEG or WebP", name, problem);
}

[[noreturn]] void refuse(const std::string& name, const std::string& problem) {
    throw UnreadablePicture(refusal(name, problem));
}

[[noreturn]] void refuseAsTooLarge(const std::string& name, const std::string& problem) {
    throw InputError(refusal(name, problem));
}

void checkSize(std::uint64_t width, std::uint64_t height, std::size_t file_bytes, const std::string& name) {
    if (width == 0 || height == 0) refuse(name, "has no pixels");
    if (width > maxSide_px || height > maxSide_px || width * height > maxPixels)
        refuseAsTooLarge(name, fmt::format("is {} x {} pixels; at most {} a side and {} in all can be read",
                                           width, height, maxSide_px, maxPixels));
    const std::uint64_t decoded_bytes = width * height * 4;
    if (decoded_bytes > harmless_bytes && decoded_bytes / maxExpansion > file_bytes)
        refuseAsTooLarge(name, fmt::format("would grow from {} to {} bytes", file_bytes, decoded_bytes));
}

// JPEG
// --------------------------------------------------------------------------------------------------------------

bool isJpeg(std::span<const std::byte> bytes) {
    return bytes.size() >= 3 && bytes[0] == std::byte(0xff) && bytes[1] == std::byte(0xd8) &&
           bytes[2] == std::byte(0xff);
}

struct JpegErrors {
    jpeg_error_mgr manager;  // first: libjpeg hands back a pointer to it
    std::jmp_buf jump;
    Message message;
};

void onJpegError(j_common_ptr jpeg) {
    auto& errors = *reinterpret_cast<JpegErrors*>(jpeg->err);
    jpeg->err->format_message(jpeg, errors.message.text.data());
    std::longjmp(errors.jump, 1);
}

// libjpeg carries on with grey where data is missing or damaged. That is an error here, but for oddities that
// cost no pixel.
void onJpegMessage(j_common_ptr jpeg, int level) {
    const int code = jpeg->err->msg_code;
    if (level < 0 && code != JWRN_EXTRANEOUS_DATA && code != JWRN_ADOBE_XFORM && code != JWRN_JFIF_MAJOR)
        onJpegError(jpeg);
}

void onJpegProgress(j_common_ptr jpeg) {
    const auto* decompress = reinterpret_cast<j_decompress_ptr>(jpeg);
    if (decompress->input_scan_number > maxScans) ERREXIT(jpeg, JERR_BAD_PROGRESSION);
}

class JpegReader {
  public:
    explicit JpegReader(std::span<const std::byte> bytes) : bytes_(bytes) {
        jpeg_.err = jpeg_std_error(&errors_.manager);
        errors_.manager.error_exit = onJpegError;
        errors_.manager.emit_message = onJpegMessage;
        progress_.progress_monitor = onJpegProgress;
    }
    ~JpegReader() { jpeg_destroy_decompress(&jpeg_); }
    JpegReader(const JpegReader&) = delete;
    JpegReader& operator=(const JpegReader&) = delete;

    const char* message() const { return errors_.message.text.data(); }
    int components() const { return jpeg_.num_components; }

    bool readHeader(std::uint32_t& width, std::uint32_t& height) {
        if (setjmp(errors_.jump)) return false;
        jpeg_create_decompress(&jpeg_);
        jpeg_.progress = &progress_;
        jpeg_mem_src(&jpeg_, reinterpret_cast<const unsigned char*>(bytes_.data()), bytes_.size());
        jpeg_read_header(&jpeg_, TRUE);
        width = jpeg_.image_width;
        height = jpeg_.image_height;
        return true;
    }

    bool readPixels(JSAMPARRAY rows) {
        if (setjmp(errors_.jump)) return false;
        jpeg_.out_color_space = JCS_EXT_RGBA;
        jpeg_start_decompress(&jpeg_);
        while (jpeg_.output_scanline < jpeg_.output_height)
            jpeg_read_scanlines(&jpeg_, rows + jpeg_.output_scanline,
                                jpeg_.output_height - jpeg_.output_scanline);
        jpeg_finish_decompress(&jpeg_);
        return true;
    }

  private:
    std::span<const std::byte> bytes_;
    jpeg_decompress_struct jpeg_{};
    jpeg_progress_mgr progress_{};
    JpegErrors errors_{};
};

// WebP
// --------------------------------------------------------------------------------------------------------------

bool isWebp(std::span<const std::byte> bytes) {
    return bytes.size() >= 12 && std::memcmp(bytes.data(), "RIFF", 4) == 0 &&
           std::memcmp(bytes.data() + 8, "WEBP", 4) == 0;
}

class WebpReader {
  public:
    explicit WebpReader(std::span<const std::byte> bytes)
        : data_(reinterpret_cast<const std::uint8_t*>(bytes.data())), size_bytes_(bytes.size()) {}

    const char* message() const { return message_; }

    bool readHeader(std::uint32_t& width, std::uint32_t& height) {
        WebPBitstreamFeatures features{};
        if (WebPGetFeatures(data_, size_bytes_, &features) != VP8_STATUS_OK) return false;
        if (features.has_animation) {
            message_ = "it moves";
            return false;
        }
        width = std::uint32_t(features.width);
        height = std::uint32_t(features.height);
        return true;
    }

    // Into rows that lie one after the other.
    bool readPixels(std::uint8_t** rows) {
        std::uint32_t width = 0, height = 0;
        if (!readHeader(width, height)) return false;
        const int row_bytes = int(width) * 4;
        return WebPDecodeRGBAInto(data_, size_bytes_, rows[0], std::size_t(row_bytes) * height, row_bytes) !=
               nullptr;
    }

  private:
    const std::uint8_t* data_;
    std::size_t size_bytes_;
    const char* message_ = "its data cannot be decoded";
};

// All
// --------------------------------------------------------------------------------------------------------------

template <class Reader>
PictureSize readSize(Reader& reader, std::size_t file_bytes, const std::string& name) {
    std::uint32_t width = 0, height = 0;
    if (!reader.readHeader(width, height)) refuse(name, fmt::format("is damaged ({})", reader.message()));
    checkSize(width, height, file_bytes, name);
    if constexpr (std::is_same_v<Reader, JpegReader>)
        if (reader.components() != 1 && reader.components() != 3) refuse(name, "is a CMYK JPEG, not RGB");
    return {int(width), int(height)};
}

template <class Reader>
Picture decode(Reader&& reader, std::size_t file_bytes, const std::string& name) {
    const PictureSize size = readSize(reader, file_bytes, name);
    Picture picture{name, size.width_px, size.height_px, {}};
    picture.rgba.resize(std::size_t(size.width_px) * std::size_t(size.height_px) * 4);
    std::vector<std::uint8_t*> rows(std::size_t(size.height_px));
    for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = &picture.rgba[y * std::size_t(size.width_px) * 4];
    if (!reader.readPixels(rows.data())) refuse(name, fmt::format("is damaged ({})", reader.message()));
    return picture;
}

}  // namespace

PictureSize readPictureSize(std::span<const std::byte> bytes, const std::string& nameForMessages) {
    if (isPng(bytes)) {
        PngReader reader(bytes);
        return readSize(reader, bytes.size(), nameForMessages);
    }
    if (isJpeg(bytes)) {
        JpegReader reader(bytes);
        return readSize(reader, bytes.size(), nameForMessages);
    }
    if (isWebp(bytes)) {
        WebpReader reader(bytes);
        return readSize(reader, bytes.size(), nameForMessages);
    }
    refuse(nameForMessages, "is neither PNG nor JPEG nor WebP");
}

Picture decodePicture(std::span<const std::byte> bytes, const std::string& nameForMessages) {
    if (isPng(bytes)) return decode(PngReader(bytes), bytes.size(), nameForMessages);
    if (isJpeg(bytes)) return decode(JpegReader(bytes), bytes.size(), nameForMessages);
    if (isWebp(bytes)) return decode(WebpReader(bytes), bytes.size(), nameForMessages);
    refuse(nameForMessages, "is neither PNG nor JPEG nor WebP");
}

}  // namespace penumbra::studio
