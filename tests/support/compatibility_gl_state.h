// SPDX-License-Identifier: Apache-2.0
// What compatibility contexts have besides. In core contexts these functions do nothing.
#pragma once

#include "tests/support/gl_state.h"

namespace penumbra::test {

void captureCompatibilityState(GlState& state);

/// A fixed-function renderer in the middle of its frame.
void setOddCompatibilityState();

/// Undoes of it what would falsify pixels that are read.
void resetCompatibilityTransfer();

}  // namespace penumbra::test
