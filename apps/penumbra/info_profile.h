// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace penumbra::studio {

/// Prints what a luminaire's file says, and its candela in the directions "GAMMA,C", degrees. Throws
/// UsageError for directions that are none, InputError for a file that cannot be read.
void printProfile(const std::string& file, const std::vector<std::string>& directions, bool json);

}  // namespace penumbra::studio
