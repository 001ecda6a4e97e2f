// SPDX-License-Identifier: Apache-2.0
// The command, run as a script runs it.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/own_cache.h"

namespace penumbra::studio {

namespace fs = std::filesystem;

struct Outcome {
    int exitCode = -1;
    std::string out, err;
};

inline std::string readText(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return std::move(text).str();
}

class CommandTest : public ::testing::Test {
  protected:
    void SetUp() override {
        fs::create_directories(folder);
        setOwnCache(folder / "cache");
    }
    void TearDown() override {
        fs::permissions(folder, fs::perms::owner_all);
        fs::remove_all(folder);
    }

    Outcome run(const std::string& arguments) const {
        const fs::path out = folder / "stdout", err = folder / "stderr";
        const int status = std::system(
            (PENUMBRA_COMMAND " " + arguments + " >" + out.string() + " 2>" + err.string()).c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readText(out), readText(err)};
    }
    std::string at(const std::string& name) const { return (folder / name).string(); }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder / name) << text;
    }

    /// Everything in the folder but what run() and the cache leave.
    std::vector<std::string> files() const {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder)) {
            const std::string name = entry.path().filename();
            if (name != "stdout" && name != "stderr" && name != "cache") names.push_back(name);
        }
        std::ranges::sort(names);
        return names;
    }

    const fs::path folder = fs::temp_directory_path() / ("penumbra-command-" + std::to_string(getpid()));
};

}  // namespace penumbra::studio
