// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/shader_watch.h"

#include <algorithm>

namespace penumbra::studio::viewer {

namespace fs = std::filesystem;

ShaderWatch::ShaderWatch(fs::path sourceDirectory)
    : folder_(std::move(sourceDirectory)), seen_(newest()), lookedAt_(std::chrono::steady_clock::now()) {}

bool ShaderWatch::changed() {
    const auto now = std::chrono::steady_clock::now();
    if (folder_.empty() || now - lookedAt_ < std::chrono::milliseconds(500)) return false;
    lookedAt_ = now;
    const fs::file_time_type time = newest();
    const bool isNewer = time > seen_;
    seen_ = std::max(seen_, time);
    return isNewer;
}

fs::file_time_type ShaderWatch::newest() const {
    fs::file_time_type time = fs::file_time_type::min();
    for (const char* root : {"src", "studio"}) {
        std::error_code error;
        for (fs::recursive_directory_iterator it(folder_ / root, error), end; !error && it != end;
             it.increment(error)) {
            const std::string name = it->path().filename();
            if (!name.ends_with(".glsl") && !name.ends_with("_io.h")) continue;
            const fs::file_time_type written = it->last_write_time(error);
            if (!error) time = std::max(time, written);
        }
    }
    return time;
}

}  // namespace penumbra::studio::viewer
