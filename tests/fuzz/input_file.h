// SPDX-License-Identifier: Apache-2.0
// What libFuzzer hands over, as a file, for code that reads files.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace penumbra::studio::fuzz {

/// One file in a folder of its own, which is in memory where there is /dev/shm; both go with the process.
class InputFile {
  public:
    explicit InputFile(const std::string& name) {
        const std::filesystem::path shared = "/dev/shm";
        const std::filesystem::path parent =
            std::filesystem::exists(shared) ? shared : std::filesystem::temp_directory_path();
        std::string pattern = (parent / "penumbra-fuzz-XXXXXX").string();
        if (::mkdtemp(pattern.data()) == nullptr) std::abort();
        folder_ = pattern;
        path_ = folder_ / name;
    }
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;
    ~InputFile() { std::filesystem::remove_all(folder_); }

    void write(const std::uint8_t* data, std::size_t size) const {
        const int file = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
        if (file < 0 || ::write(file, data, size) != ssize_t(size)) std::abort();
        ::close(file);
    }
    const std::filesystem::path& path() const { return path_; }
    const std::filesystem::path& folder() const { return folder_; }

  private:
    std::filesystem::path folder_, path_;
};

}  // namespace penumbra::studio::fuzz
