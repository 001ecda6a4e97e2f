// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string_view>

#include "penumbra/device.h"
#include "src/gl/gl.h"

namespace penumbra::gl {

/// Passes the driver's KHR_debug messages on and counts the severe ones. Installs itself only where the host
/// has no callback of its own; stays at its address while it is installed.
class DebugLog {
  public:
    DebugLog(std::function<void(LogLevel, std::string_view)> log, std::shared_ptr<const Ledger> ledger);
    DebugLog(const DebugLog&) = delete;
    DebugLog& operator=(const DebugLog&) = delete;
    ~DebugLog();

    void write(LogLevel level, std::string_view message) const {
        if (log_) log_(level, message);
    }
    void receive(unsigned type, unsigned severity, std::string_view message);
    int severeMessageCount() const { return severeMessages_; }

  private:
    std::function<void(LogLevel, std::string_view)> log_;
    std::atomic<int> severeMessages_ = 0;
    std::shared_ptr<const Ledger> ledger_;
    bool installed_ = false;
};

}  // namespace penumbra::gl
