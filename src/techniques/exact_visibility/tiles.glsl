// SPDX-License-Identifier: Apache-2.0
// Candidates for each tile of 8 x 8 receivers.
#include "src/techniques/exact_visibility/exact_io.h"
