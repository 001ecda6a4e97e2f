// SPDX-License-Identifier: Apache-2.0
// Pictures that were made larger, for antialiasing.
#pragma once

#include "studio/image/image.h"

namespace penumbra::studio {

/// Each pixel the mean of `factor` x `factor` of `image`, whose sides are multiples of it. Of linear values.
Image downsampled(const Image& image, int factor);

/// The same of sRGB-encoded values, which are averaged as the light that they show.
Image downsampledSrgb(Image image, int factor);

}  // namespace penumbra::studio
