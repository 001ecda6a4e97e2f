// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "penumbra/view.h"
#include "src/device/device_internals.h"
#include "src/device/host_state.h"

namespace penumbra {

/// Every entry into the library that draws or computes: from the host's state to a known one and, when it is
/// destroyed, back. Objects made meanwhile belong to the device.
class HostScope {
  public:
    /// Throws as Device::Internals::requireContext does, and badArgument where the host records transform
    /// feedback, which forbids other programs, or a display list, or is in select or feedback mode.
    explicit HostScope(const Device::Internals& device);

    /// What the host has set, and has on.
    PolygonOffset hostsPolygonOffset() const { return polygonOffset_; }

  private:
    gl::ObjectRegistryScope registry_;
    PolygonOffset polygonOffset_;
    std::optional<HostState> state_;
};

}  // namespace penumbra
