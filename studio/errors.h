// SPDX-License-Identifier: Apache-2.0
// What can go wrong in the command, by exit code. The message names file, place and remedy.
#pragma once

#include <stdexcept>

namespace penumbra::studio {

/// A threshold that the user asked for is exceeded: exit code 1.
struct ThresholdError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Bad flags or arguments: exit code 2.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A file that is missing, unreadable or invalid: exit code 3.
struct InputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// An output that cannot be written: exit code 5.
struct OutputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace penumbra::studio
