// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "src/device_internals.h"
#include "src/hosting/host_state.h"

namespace penumbra {

/// Every entry into the library that draws or computes: from the host's state to a known one and, when it is
/// destroyed, back. Objects made meanwhile belong to the device.
class HostScope {
  public:
    /// Throws Error::Kind::lostContext, or badArgument where the host records transform feedback, which
    /// forbids other programs.
    explicit HostScope(const Device::Internals& device);

  private:
    gl::LedgerScope ledger_;
    std::optional<HostState> state_;
};

}  // namespace penumbra
