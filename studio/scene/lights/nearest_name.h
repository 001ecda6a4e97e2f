// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace penumbra::studio {

/// What to append to a message about an unknown name: "; did you mean 'radius'?" where one of `names` is near
/// (Levenshtein distance at most a third of the longer name's length, at least 1, case ignored), else
/// nothing.
std::string didYouMean(std::string_view name, std::span<const std::string_view> names);

}  // namespace penumbra::studio
