// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/lights/nearest_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <vector>

namespace penumbra::studio {
namespace {

/// How many letters to insert, delete or replace (Levenshtein 1966), by rows of the dynamic programme.
std::size_t editDistance(std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t(0));
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (lower(a[i]) != lower(b[j]));
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

}  // namespace

std::string didYouMean(std::string_view name, std::span<const std::string_view> names) {
    constexpr std::size_t longestTyped = 64;  // the cost is quadratic, and files are not trusted
    if (name.size() > longestTyped) return "";
    std::string_view nearest;
    std::size_t nearestDistance = 0;
    for (std::string_view candidate : names) {
        if (candidate.size() > longestTyped) continue;
        const std::size_t distance = editDistance(name, candidate);
        if (distance <= std::max<std::size_t>(1, std::max(name.size(), candidate.size()) / 3) &&
            (nearest.empty() || distance < nearestDistance)) {
            nearest = candidate;
            nearestDistance = distance;
        }
    }
    return nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest);
}

}  // namespace penumbra::studio
