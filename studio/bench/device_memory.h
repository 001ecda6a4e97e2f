// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace penumbra::studio {

/// What all textures and buffers of the current context hold, in bytes, without the driver's own padding: a
/// census of their names, which every driver gives out from 1 upwards. The difference of two is what was made
/// between. Slow; not for a frame.
std::size_t memoryInUse_bytes();

}  // namespace penumbra::studio
