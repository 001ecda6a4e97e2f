// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/file_beside.h"

#include <fmt/format.h>

#include <fstream>
#include <system_error>

#include "studio/errors.h"

namespace penumbra::studio {

namespace fs = std::filesystem;

std::vector<std::byte> readWholeFile(const fs::path& file, std::uintmax_t limit_bytes,
                                     const std::string& where) {
    std::error_code error;
    if (!fs::is_regular_file(file, error))
        throw InputError(fmt::format("{}: '{}' {}", where, file.string(),
                                     fs::exists(file, error) ? "is not a file" : "does not exist"));
    const std::uintmax_t size = fs::file_size(file, error);
    if (error || size > limit_bytes)
        throw InputError(
            fmt::format("{}: '{}' is larger than {} MiB", where, file.string(), limit_bytes >> 20));
    std::vector<std::byte> bytes(size);
    std::ifstream stream(file, std::ios::binary);
    if (!stream.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(size)))
        throw InputError(fmt::format("{}: '{}' cannot be read", where, file.string()));
    return bytes;
}

fs::path fileBeneath(const fs::path& folder, const std::string& text, const std::string& what) {
    const fs::path relative(text);
    bool inside = relative.is_relative() && text.find('\\') == text.npos && text.find(':') == text.npos &&
                  text.find('\0') == text.npos;
    for (const fs::path& part : relative) inside = inside && part != "..";
    const fs::path file = folder / relative;
    std::error_code error;
    if (inside && fs::exists(file, error)) {
        const fs::path target = fs::canonical(file, error)
                                    .lexically_relative(fs::canonical(folder.empty() ? "." : folder, error));
        inside = !error && !target.empty() && *target.begin() != "..";
    }
    if (!inside)
        throw InputError(
            fmt::format("{} must be a path beneath the file's own folder, not '{}'", what, text));
    return file;
}

}  // namespace penumbra::studio
