// SPDX-License-Identifier: Apache-2.0
// Names of a comparison's files, agreed between whoever writes them and whoever links to them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace penumbra::studio {

inline constexpr std::string_view referenceName = "reference";

/// ".LIGHT" where there are several lights, else empty. What no file name should hold becomes '_'.
std::string lightSuffix(const std::string& light, std::size_t lightCount);
/// A technique's name or label as part of a file's name and of a link to it.
std::string fileStem(const std::string& technique);
std::string visibilityFile(const std::string& technique, const std::string& suffix);
std::string differenceFile(const std::string& technique, const std::string& suffix);

/// 0 of nothing.
double medianOf(std::vector<double> values);

}  // namespace penumbra::studio
