// SPDX-License-Identifier: Apache-2.0
#include "studio/image/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <utility>

#include "studio/errors.h"

namespace penumbra::studio {
namespace {

namespace fs = std::filesystem;

std::string remedyFor(int error) {
    switch (error) {
        case ENOENT:
        case ENOTDIR:
            return "create the folder first, or name another";
        case EACCES:
        case EPERM:
        case EROFS:
            return "choose a folder that you may write to";
        case ENOSPC:
        case EDQUOT:
        case EFBIG:
            return "free some space, or write to another disk";
        case EISDIR:
            return "name a file, not a folder";
        case ENAMETOOLONG:
            return "choose a shorter name";
        default:
            return "check the disk, or write elsewhere";
    }
}

[[noreturn]] void fail(const fs::path& path, int error) {
    throw OutputError(
        fmt::format("cannot write '{}': {}; {}", path.string(), std::strerror(error), remedyFor(error)));
}

/// A new file beside `target`; removed again unless it was renamed over it.
class TemporaryFile {
  public:
    explicit TemporaryFile(const fs::path& target)
        : target_(target), name_((target.parent_path() / ".penumbra-XXXXXX.tmp").string()) {
        descriptor_ = ::mkostemps(name_.data(), 4, O_CLOEXEC);
        if (descriptor_ < 0) fail(target_, errno);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        if (descriptor_ >= 0) ::close(descriptor_);
        if (!renamed_) ::unlink(name_.c_str());
    }

    void write(std::span<const std::byte> bytes) {
        while (!bytes.empty()) {
            const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) fail(target_, errno);
            bytes = bytes.subspan(std::size_t(written));
        }
    }

    void renameOverTarget() {
        // mkostemps makes the file private; give it the mode that an ordinary new file has. The mask can only
        // be read by setting it, which other threads would see, hence Linux's own account of it is asked
        // instead.
        if (::fchmod(descriptor_, 0666 & ~currentUmask()) != 0) fail(target_, errno);
        // Some file systems report a full disk only now.
        if (const int closed = ::close(std::exchange(descriptor_, -1)); closed != 0) fail(target_, errno);
        if (std::rename(name_.c_str(), target_.c_str()) != 0) fail(target_, errno);
        renamed_ = true;
    }

  private:
    static mode_t currentUmask() {
        std::ifstream status("/proc/self/status");
        for (std::string line; std::getline(status, line);) {
            if (line.starts_with("Umask:")) return mode_t(std::strtoul(line.c_str() + 6, nullptr, 8));
        }
        return 022;
    }

    fs::path target_;
    std::string name_;
    int descriptor_ = -1;
    bool renamed_ = false;
};

}  // namespace

void writeFileAtomically(const fs::path& path, std::span<const std::byte> bytes) {
    std::error_code ignored;
    if (!path.has_filename() || fs::is_directory(path, ignored)) fail(path, EISDIR);
    TemporaryFile file(path);
    file.write(bytes);
    file.renameOverTarget();
}

void writeFileAtomically(const fs::path& path, std::string_view text) {
    writeFileAtomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

std::vector<std::byte> readWholeFile(const fs::path& path, std::size_t limit_bytes) {
    const auto refuse = [&](std::string_view why) {
        return InputError(fmt::format("cannot read '{}': {}", path.string(), why));
    };
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status)) throw refuse("there is no such file; check the name");
    if (!fs::is_regular_file(status)) throw refuse("it is not a regular file; name a file");
    const std::uintmax_t size = fs::file_size(path, error);
    if (error) throw refuse(error.message() + "; check the disk");
    if (size > limit_bytes)
        throw refuse(fmt::format("it is larger than {} bytes; use a smaller one", limit_bytes));
    std::vector<std::byte> bytes(size);
    std::ifstream stream(path, std::ios::binary);
    if (!stream.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(size))) {
        throw refuse("it cannot be opened or read to its end; check its permissions");
    }
    return bytes;
}

}  // namespace penumbra::studio
