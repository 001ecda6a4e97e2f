// SPDX-License-Identifier: Apache-2.0
#include "studio/image/png_reader.h"

#include <csetjmp>
#include <cstdio>
#include <cstring>

namespace penumbra::studio {
namespace {

constexpr std::size_t maxChunk_bytes = 8u << 20;

void onWarning(png_structp, png_const_charp) {}

}  // namespace

bool isPng(std::span<const std::byte> bytes) {
    constexpr std::size_t signature_bytes = 8;
    return bytes.size() >= signature_bytes &&
           png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, signature_bytes) == 0;
}

PngReader::PngReader(std::span<const std::byte> bytes) : rest_(bytes) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, onError, onWarning);
    info_ = png_ ? png_create_info_struct(png_) : nullptr;
    if (!info_) std::snprintf(message_.data(), message_.size(), "out of memory");
}

PngReader::~PngReader() {
    png_destroy_read_struct(&png_, &info_, nullptr);
}

// The functions that call setjmp have trivial locals only, and what they fill belongs to their callers.

bool PngReader::readHeader(std::uint32_t& width, std::uint32_t& height) {
    if (!info_ || setjmp(png_jmpbuf(png_))) return false;
    png_set_read_fn(png_, this, take);
    png_set_user_limits(png_, 0x7fffffff, 0x7fffffff);  // the caller says it better
    png_set_chunk_malloc_max(png_, maxChunk_bytes);
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, 0);
    png_read_info(png_, info_);
    width = png_get_image_width(png_, info_);
    height = png_get_image_height(png_, info_);
    return true;
}

int PngReader::channels() const {
    const int type = png_get_color_type(png_, info_);
    if ((type & PNG_COLOR_MASK_ALPHA) || png_get_valid(png_, info_, PNG_INFO_tRNS)) return 4;
    return type & PNG_COLOR_MASK_COLOR ? 3 : 1;
}

bool PngReader::readPixels(png_bytepp rows) {
    if (setjmp(png_jmpbuf(png_))) return false;
    png_set_expand(png_);
    png_set_scale_16(png_);
    png_set_gray_to_rgb(png_);
    png_set_add_alpha(png_, 0xff, PNG_FILLER_AFTER);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    png_read_image(png_, rows);
    png_read_end(png_, info_);
    return true;
}

Metadata PngReader::texts() const {
    Metadata metadata;
    png_textp chunks = nullptr;
    const int count = png_get_text(png_, info_, &chunks, nullptr);
    for (int i = 0; i < count; ++i) metadata[chunks[i].key] = chunks[i].text;
    return metadata;
}

void PngReader::take(png_structp png, png_bytep out, std::size_t count) {
    auto& rest = static_cast<PngReader*>(png_get_io_ptr(png))->rest_;
    if (count > rest.size()) png_error(png, "ends too early");
    std::memcpy(out, rest.data(), count);
    rest = rest.subspan(count);
}

void PngReader::onError(png_structp png, png_const_charp text) {
    auto& message = static_cast<PngReader*>(png_get_error_ptr(png))->message_;
    std::snprintf(message.data(), message.size(), "%s", text);
    png_longjmp(png, 1);
}

}  // namespace penumbra::studio
