// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

namespace penumbra::studio {

/// Progress on standard error: a bar with the time left on a terminal, a plain line now and then elsewhere.
class Progress {
  public:
    explicit Progress(std::string what);
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress();

    /// `fraction` of the work is done, in [0, 1]; where the work has stages, of the one called `stage`.
    void update(double fraction, const std::string& stage = "");

  private:
    std::string what_;
    std::string stage_;
    bool terminal_;
    std::chrono::steady_clock::time_point start_;
    std::chrono::steady_clock::time_point shown_;
    bool drawn_ = false;
};

}  // namespace penumbra::studio
