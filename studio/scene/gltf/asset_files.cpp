// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/gltf/asset_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <span>
#include <string_view>

namespace penumbra::studio::gltf {

namespace {

namespace fs = std::filesystem;

class FileDescriptor {
  public:
    explicit FileDescriptor(int descriptor) : descriptor_(descriptor) {}
    ~FileDescriptor() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    FileDescriptor(const FileDescriptor&) = delete;
    FileDescriptor& operator=(const FileDescriptor&) = delete;
    int get() const { return descriptor_; }

  private:
    int descriptor_;
};

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

std::string percentDecoded(std::string_view text, const JsonView& uri) {
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            decoded += text[i];
            continue;
        }
        if (i + 2 >= text.size() || hexDigit(text[i + 1]) < 0 || hexDigit(text[i + 2]) < 0)
            uri.fail("has a '%' that two hexadecimal digits do not follow");
        decoded += char(hexDigit(text[i + 1]) * 16 + hexDigit(text[i + 2]));
        i += 2;
    }
    return decoded;
}

constexpr std::array<std::int8_t, 256> base64Values() {
    constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<std::int8_t, 256> values{};
    values.fill(-1);
    for (std::size_t i = 0; i < alphabet.size(); ++i) values[std::uint8_t(alphabet[i])] = std::int8_t(i);
    return values;
}

// RFC 4648, section 4; padding may be missing.
Bytes base64Decoded(std::string_view text, const JsonView& uri) {
    static constexpr std::array<std::int8_t, 256> values = base64Values();
    while (!text.empty() && text.back() == '=') text.remove_suffix(1);
    Bytes bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int bitCount = 0;
    for (const char c : text) {
        const int value = values[std::uint8_t(c)];
        if (value < 0) uri.fail("is not valid base64");
        bits = bits << 6 | std::uint32_t(value);
        bitCount += 6;
        if (bitCount < 8) continue;
        bitCount -= 8;
        bytes.push_back(std::byte(bits >> bitCount & 0xff));
    }
    return bytes;
}

Bytes decodedDataUri(std::string_view afterScheme, const JsonView& uri, Budget& budget) {
    const std::size_t comma = afterScheme.find(',');
    if (comma == std::string_view::npos) uri.fail("is a data URI without a comma");
    const std::string_view content = afterScheme.substr(comma + 1);
    budget.charge(content.size(), 1, uri.pointer());
    if (afterScheme.substr(0, comma).ends_with(";base64")) return base64Decoded(content, uri);
    const std::string text = percentDecoded(content, uri);
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

// RFC 3986, section 3.1.
bool hasScheme(std::string_view uri) {
    const std::size_t colon = uri.find(':');
    if (colon == std::string_view::npos || colon == 0 || !std::isalpha(std::uint8_t(uri[0]))) return false;
    return std::ranges::all_of(uri.substr(0, colon), [](char c) {
        return std::isalnum(std::uint8_t(c)) || c == '+' || c == '-' || c == '.';
    });
}

}  // namespace

Bytes readFile(const fs::path& path, Budget& budget, const std::string& place) {
    // O_NONBLOCK, so that opening a pipe returns at once and is refused below as not regular.
    const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (file.get() < 0)
        throw PlaceError(place,
                         fmt::format("'{}' cannot be opened ({})", path.string(), std::strerror(errno)),
                         "check that it exists and may be read");
    struct stat status {};
    if (::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode))
        throw PlaceError(place, fmt::format("'{}' is not a regular file", path.string()), "name a file");
    if (std::uint64_t(status.st_size) > maxFile_bytes)
        throw PlaceError(place, fmt::format("'{}' is larger than 2 GiB", path.string()), "split the scene");
    budget.charge(std::uint64_t(status.st_size), 1, place);

    Bytes bytes(std::size_t(status.st_size));
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t got = ::read(file.get(), bytes.data() + done, bytes.size() - done);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0)
            throw PlaceError(place, fmt::format("'{}' cannot be read to its end", path.string()),
                             "try again");
        done += std::size_t(got);
    }
    return bytes;
}

Bytes readUri(const JsonView& uri, const fs::path& folder, Budget& budget) {
    const std::string& text = uri.asString();
    if (text.starts_with("data:")) return decodedDataUri(std::string_view(text).substr(5), uri, budget);
    if (hasScheme(text))
        throw MissingFile(uri.pointer(), "must be a data URI or a path relative to the file",
                          "download what it names and name the copy");

    const fs::path relative = percentDecoded(text, uri);
    if (relative.empty() || relative.is_absolute() || relative.native().find('\0') != std::string::npos ||
        std::ranges::find(relative, fs::path("..")) != relative.end())
        throw MissingFile(uri.pointer(), "must be a path beneath the file's own folder",
                          "copy what it names there");

    // Symbolic links may point about within the folder, but not out of it.
    std::error_code error;
    const fs::path root = fs::canonical(folder, error);
    const fs::path target = error ? fs::path() : fs::canonical(root / relative, error);
    if (error)
        throw MissingFile(uri.pointer(), fmt::format("'{}' is not there", relative.string()),
                          "put the file where the scene expects it");
    const auto [rootEnd, targetRest] = std::ranges::mismatch(root, target);
    if (rootEnd != root.end() || targetRest == target.end())
        throw MissingFile(uri.pointer(), "leads out of the file's own folder by a symbolic link",
                          "copy what it names there");
    return readFile(target, budget, uri.pointer());
}

}  // namespace penumbra::studio::gltf
