// SPDX-License-Identifier: Apache-2.0
// Numbers as people read them.
#pragma once

#include <string>

namespace penumbra::studio::viewer {

/// With about so many digits that count, never with an exponent: "12345", "0.00321", "20".
std::string plainNumber(double value, int digits = 4);

/// A format of printf's for numbers about as large, for the same.
std::string plainFormat(double value, int digits = 4);

}  // namespace penumbra::studio::viewer
