// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "penumbra/caster.h"
#include "src/device/device_internals.h"

namespace penumbra {

/// Throws Error::Kind::badArgument, naming the caster and the remedy, where a mesh is missing, moved from or
/// of another device, floats cannot hold its positions, a matrix is not affine, or a mask is none. To be
/// called in a HostScope.
void checkCasters(std::span<const Caster> casters, const Device::Internals& device);

}  // namespace penumbra
