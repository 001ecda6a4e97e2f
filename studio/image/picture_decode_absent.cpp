// SPDX-License-Identifier: Apache-2.0
// In place of picture_decode.cpp in a build for the bench alone, which has no libpng and no libjpeg.
#include <fmt/format.h>

#include "studio/errors.h"
#include "studio/image/picture_decode.h"

namespace penumbra::studio {

PictureSize readPictureSize(std::span<const std::byte>, const std::string& nameForMessages) {
    throw InputError(
        fmt::format("picture '{}' cannot be read by a build for the bench alone; take the whole "
                    "build (PENUMBRA_BENCH_ALONE=OFF), or a scene without pictures",
                    nameForMessages));
}

Picture decodePicture(std::span<const std::byte> bytes, const std::string& nameForMessages) {
    readPictureSize(bytes, nameForMessages);
    return {};
}

}  // namespace penumbra::studio
