// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace penumbra::studio {

/// `word` as a POSIX shell's command line must hold it, so that the shell reads it as it is.
std::string shellWord(std::string_view word);

}  // namespace penumbra::studio
