// SPDX-License-Identifier: Apache-2.0
#include "studio/image/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
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

/// Names of files that are being written, where a signal handler may read them: fixed memory, no locks.
class UnfinishedFiles {
  public:
    /// A place for `name`, which must stay until it is given back; null where all are taken or it is too
    /// long.
    std::atomic<bool>* add(const std::string& name) {
        for (Entry& entry : entries_) {
            if (name.size() >= entry.name.size() || entry.taken.exchange(true)) continue;
            std::memcpy(entry.name.data(), name.c_str(), name.size() + 1);
            entry.isThere = true;
            return &entry.isThere;
        }
        return nullptr;
    }
    void remove(std::atomic<bool>* place) {
        for (Entry& entry : entries_) {
            if (&entry.isThere != place) continue;
            entry.isThere = false;
            entry.taken = false;
        }
    }
    /// May be called in a signal handler.
    void unlinkAll() const {
        for (const Entry& entry : entries_) {
            if (entry.isThere) ::unlink(entry.name.data());
        }
    }

  private:
    struct Entry {
        std::atomic<bool> taken = false, isThere = false;
        std::array<char, PATH_MAX> name{};
    };
    std::array<Entry, 8> entries_;
};

/// A signal handler has no other way to them.
UnfinishedFiles unfinishedFiles;

void removeAndEnd(int signal) {
    unfinishedFiles.unlinkAll();
    ::raise(signal);  // which has its default effect again
}

/// A new file beside `target`; removed again unless it was renamed over it.
class TemporaryFile {
  public:
    explicit TemporaryFile(const fs::path& target) : target_(target) {
        static std::atomic<unsigned> count = 0;
        do {
            unfinishedFiles.remove(place_);
            name_ = (target.parent_path() / fmt::format(".penumbra-{}-{}.tmp", ::getpid(), count++)).string();
            place_ = unfinishedFiles.add(name_);
            descriptor_ = ::open(name_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
        } while (descriptor_ < 0 && errno == EEXIST);
        if (descriptor_ >= 0) return;
        const int error = errno;
        unfinishedFiles.remove(place_);
        fail(target_, error);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        if (descriptor_ >= 0) ::close(descriptor_);
        if (!renamed_) ::unlink(name_.c_str());
        unfinishedFiles.remove(place_);
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
        // The file is private so far; give it the mode that an ordinary new file has. The mask can only
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
    std::atomic<bool>* place_ = nullptr;  ///< among the unfinished
    int descriptor_ = -1;
    bool renamed_ = false;
};

}  // namespace

void removeUnfinishedFilesOnSignals() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        ::sigaction(signal, nullptr, &before);
        if (before.sa_handler == SIG_IGN) continue;
        struct sigaction action {};
        action.sa_handler = removeAndEnd;
        action.sa_flags = int(SA_RESETHAND);
        ::sigaction(signal, &action, nullptr);
    }
}

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
