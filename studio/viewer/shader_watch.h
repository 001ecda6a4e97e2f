// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>

namespace penumbra::studio::viewer {

/// Notices that a shader of a source tree was written.
class ShaderWatch {
  public:
    /// `sourceDirectory` empty: there is nothing to watch.
    explicit ShaderWatch(std::filesystem::path sourceDirectory);

    /// Whether anything was written since the last call; looks at most twice a second.
    bool changed();

  private:
    std::filesystem::file_time_type newest() const;

    std::filesystem::path folder_;
    std::filesystem::file_time_type seen_;
    std::chrono::steady_clock::time_point lookedAt_;
};

}  // namespace penumbra::studio::viewer
