// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "penumbra/diagnose.h"
#include "src/device/device_internals.h"

namespace penumbra {

/// penumbra::diagnose of inputs that are checked, in a HostScope.
Diagnosis diagnoseInScope(Device::Internals& device, const View& view, std::span<const Caster> casters);

}  // namespace penumbra
