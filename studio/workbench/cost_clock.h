// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>

#include "penumbra/device.h"
#include "src/gl/pass_timers.h"

namespace penumbra::studio {

/// What work on a device costs. On a software driver the device is this process: the CPU time of all its
/// threads counts, which other programs on the machine hardly disturb. Elsewhere the device keeps its own
/// time.
class CostClock {
  public:
    /// The device's context must be current here and whenever the clock is used.
    explicit CostClock(const Device& device);

    /// Runs `work` between two waits for the device and returns its cost in milliseconds.
    double milliseconds(const std::function<void()>& work) const;

    /// "process CPU time" or "GPU timer queries", as reports name it.
    std::string_view name() const;

  private:
    bool software_;
    gl::Handle<gl::deleteQuery> begin_, end_;
};

}  // namespace penumbra::studio
