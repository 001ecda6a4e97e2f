// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace penumbra::studio::viewer {
namespace {

int decimalsOf(double value, int digits) {
    constexpr int most = 9;
    if (!(std::abs(value) > 0) || !std::isfinite(value)) return digits - 1;
    return std::clamp(digits - 1 - int(std::floor(std::log10(std::abs(value)))), 0, most);
}

}  // namespace

std::string plainNumber(double value, int digits) {
    std::string text = fmt::format("{:.{}f}", value, decimalsOf(value, digits));
    if (text.find('.') == std::string::npos) return text;
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
}

std::string plainFormat(double value, int digits) {
    return fmt::format("%.{}f", decimalsOf(value, digits));
}

}  // namespace penumbra::studio::viewer
