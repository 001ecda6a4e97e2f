// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "studio/image/image.h"

namespace penumbra::studio {

/// Colour of a signed number, as shown (sRGB-encoded): blue at -1 and less, nearly white at 0, red at 1 and
/// more, magenta for what is not a number. Equally far from 0 is equally dark, so that it reads in grey, too.
std::array<float, 3> divergingColor(float value);

/// `gain` times (test - truth) in diverging colours: red where the test is too light, blue where it is too
/// dark. Colours saturate at an error of 1 / gain. Several channels count by their mean; a test of one
/// channel is compared with each. Throws InputError if sizes or channels do not fit.
Image differenceImage(const Image& truth, const Image& test, float gain = 5);

}  // namespace penumbra::studio
