// SPDX-License-Identifier: Apache-2.0
// Numbers as colours, and where to draw lines between them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace penumbra::studio {

/// The colour (sRGB-encoded) of `t` in [0, 1], clamped: dark blue over green to light yellow. CIE lightness
/// rises evenly from 14 to 94, so that the order is seen at once, by the colour-blind and in grey print too.
std::array<float, 3> orderedColor(float t);

/// 256 colours of a map over [0, 1], RGBA8.
using ColorTable = std::array<std::uint8_t, 256 * 4>;
ColorTable orderedColors();
/// studio/metrics' diverging colours over [-1, 1]: blue (too dark), white, red (too light).
ColorTable divergingColors();

/// 1, 2, 5, 10, 20, 50 ... and their fractions within [min, max], both positive.
std::vector<float> niceLevels(float min, float max);

/// A range that shows everything up to `largest` and ends on a nice level; from a thousandth of it where
/// logarithmic, from 0 else.
struct ValueRange {
    float min = 0, max = 1;
};
ValueRange niceRange(float largest, bool logarithmic);

}  // namespace penumbra::studio
