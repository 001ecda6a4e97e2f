// SPDX-License-Identifier: Apache-2.0
// Words on pictures, and pictures side by side.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "studio/image/image.h"

namespace penumbra::studio {

inline constexpr int glyphWidth_px = 6;   ///< at scale 1, with the gap to the next glyph
inline constexpr int glyphHeight_px = 9;  ///< at scale 1, with the gap to the next line

/// Draws `text` with its top left corner at (x, y), each dot of the font `scale` pixels wide; what falls
/// outside the image is cut. "\n" starts a new line; characters other than printable ASCII show as a box. A
/// grey image gets the colour's mean; an alpha channel is set to 1 under the dots.
void drawLabel(Image& image, int x, int y, std::string_view text, int scale = 1,
               const std::array<float, 3>& color = {1, 1, 1});

struct LabelledImage {
    std::string label;
    Image image;  ///< values as they shall be shown (sRGB-encoded), 1 channel (grey) or 3
};

/// The images in rows of `columns`, left to right, each under its label, on dark grey. Cells are as large as
/// the largest image; labels that are wider than their cell are cut. RGB; an empty list gives an empty image.
Image contactSheet(std::span<const LabelledImage> images, int columns, int labelScale = 2);

}  // namespace penumbra::studio
