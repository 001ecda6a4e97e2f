// SPDX-License-Identifier: Apache-2.0
// A hand-written list: name -> factory. Adding a technique is adding a line to catalog.cpp.
#pragma once

#include <string_view>

namespace penumbra {

/// The root mean square error of visibility that a technique of the catalog has at most in the penumbra of a
/// straight edge, where the truth is known in closed form. 0.29 is what a hard edge makes of a linear ramp.
float rampRmseOf(std::string_view technique);

}  // namespace penumbra
