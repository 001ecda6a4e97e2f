// SPDX-License-Identifier: Apache-2.0
// PNG or JPEG bytes of a scene: a picture of the size that was announced, or an InputError.
#include <cstdint>
#include <cstdlib>

#include "studio/errors.h"
#include "studio/image/picture_decode.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace penumbra::studio;
    constexpr std::uint64_t largest = 1u << 22;  // pixels; the loader has a budget of its own
    const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
    try {
        const PictureSize announced = readPictureSize(bytes, "picture");
        if (std::uint64_t(announced.width_px) * std::uint64_t(announced.height_px) > largest) return 0;
        const Picture picture = decodePicture(bytes, "picture");
        if (picture.width_px != announced.width_px || picture.height_px != announced.height_px) std::abort();
    } catch (const InputError&) {
    }
    return 0;
}
