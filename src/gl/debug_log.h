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
/// has no callback of its own.
class DebugLog {
  public:
    DebugLog(std::function<void(LogLevel, std::string_view)> log,
             std::shared_ptr<const ObjectRegistry> registry);
    DebugLog(const DebugLog&) = delete;
    DebugLog& operator=(const DebugLog&) = delete;
    ~DebugLog();

    /// Forgets the host's function, and gives the context's callback back.
    void close();

    void write(LogLevel level, std::string_view message) const { sink_->write(level, message); }
    int severeMessageCount() const { return sink_->severeMessages; }

  private:
    /// What the context's callback knows.
    struct Sink {
        std::function<void(LogLevel, std::string_view)> log;
        std::atomic<int> severeMessages = 0;
        /// Of one that could not be taken out of its context, which may yet call it: it lives on.
        std::shared_ptr<Sink> itself;

        void write(LogLevel level, std::string_view message) const {
            if (log) log(level, message);
        }
        void receive(unsigned type, unsigned severity, std::string_view message);
    };

    std::shared_ptr<Sink> sink_ = std::make_shared<Sink>();
    std::shared_ptr<const ObjectRegistry> registry_;
    bool installed_ = false;
};

}  // namespace penumbra::gl
