// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace penumbra::studio {

/// Float pixels on the CPU, row by row from the top, channels interleaved. Linear light unless stated.
struct Image {
    int width_px = 0;
    int height_px = 0;
    int channels = 1;
    std::vector<float> values;  ///< width_px * height_px * channels

    Image() = default;
    Image(int width, int height, int channelCount, float fill = 0)
        : width_px(width),
          height_px(height),
          channels(channelCount),
          values(std::size_t(width) * height * channelCount, fill) {}

    std::size_t pixelCount() const { return std::size_t(width_px) * height_px; }
    float& at(int x, int y, int channel = 0) {
        return values[(std::size_t(y) * width_px + x) * channels + channel];
    }
    float at(int x, int y, int channel = 0) const {
        return values[(std::size_t(y) * width_px + x) * channels + channel];
    }
};

struct PictureSize {
    int width_px = 0, height_px = 0;
};

/// A decoded picture: 8-bit sRGB-encoded colour with linear alpha, rows from the top.
struct Picture {
    std::string name;
    int width_px = 0, height_px = 0;
    std::vector<std::uint8_t> rgba;
};

/// Text that travels with a picture: "Software", "penumbra:command", ...
using Metadata = std::map<std::string, std::string>;

}  // namespace penumbra::studio
