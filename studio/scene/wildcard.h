// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace penumbra::studio {

/// Whether `text` is what `pattern` describes, in which `*` stands for any characters and `?` for any one.
constexpr bool matchesWildcard(std::string_view text, std::string_view pattern) {
    std::size_t t = 0, p = 0, afterStar = std::string_view::npos, triedFrom = 0;
    while (t < text.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            afterStar = ++p;
            triedFrom = t;
        } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
            ++p, ++t;
        } else if (afterStar != std::string_view::npos) {
            p = afterStar;
            t = ++triedFrom;
        } else {
            return false;
        }
    }
    while (p < pattern.size() && pattern[p] == '*') ++p;
    return p == pattern.size();
}

static_assert(matchesWildcard("IfcWindow.3", "IfcWindow*") && !matchesWildcard("IfcDoor", "IfcWindow*"));
static_assert(matchesWildcard("abcabd", "*ab?") && !matchesWildcard("abcabd", "*ac?") &&
              matchesWildcard("", "*"));

}  // namespace penumbra::studio
