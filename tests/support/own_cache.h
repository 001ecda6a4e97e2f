// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <filesystem>

/// Gives this process, and what it starts, a cache home of its own, so that no test depends on what others
/// have left. The driver keeps its compiled shaders where it had them: making all of them again takes Mesa
/// several seconds a test.
inline void setOwnCache(const std::filesystem::path& folder) {
    const char* cache = std::getenv("XDG_CACHE_HOME");
    const char* home = std::getenv("HOME");
    if (cache)
        setenv("MESA_SHADER_CACHE_DIR", cache, 0);
    else if (home)
        setenv("MESA_SHADER_CACHE_DIR", (std::filesystem::path(home) / ".cache").c_str(), 0);
    setenv("XDG_CACHE_HOME", folder.c_str(), 1);
}
