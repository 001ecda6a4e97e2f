// SPDX-License-Identifier: Apache-2.0
// LDR-FLIP: how different two pictures look to a person who flips between them. Pontus Andersson, Jim
// Nilsson, Tomas Akenine-Möller, Magnus Oskarsson, Kalle Åström, Mark D. Fairchild, "FLIP: A Difference
// Evaluator for Alternating Images", Proceedings of the ACM on Computer Graphics and Interactive Techniques
// 3(2), 2020.
#pragma once

#include "studio/image/image.h"

namespace penumbra::studio {

/// The paper's default: a display 0.7 m wide with 3840 pixels across, seen from 0.7 m.
inline constexpr float defaultPixelsPerDegree = 67.0206f;

/// FLIP of each pixel, 0 (looks the same) to 1; one channel. The pictures are sRGB-encoded, in [0, 1]
/// (clamped), of one channel (grey) or at least three. What is not a number spreads as far as the filters
/// reach. Throws InputError if the sizes do not fit, or pixelsPerDegree is not in (0, 1000].
Image flipMap(const Image& reference, const Image& test, float pixelsPerDegree = defaultPixelsPerDegree);

/// The mean of flipMap(), 0 for pictures without pixels.
double flip(const Image& reference, const Image& test, float pixelsPerDegree = defaultPixelsPerDegree);

}  // namespace penumbra::studio
