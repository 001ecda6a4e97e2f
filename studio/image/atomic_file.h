// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace penumbra::studio {

/// Writes a file that appears whole or not at all: the bytes go to a new file in the same folder, which is
/// then renamed over `path`. Throws OutputError, naming the path and what to do, when that fails; `path` is
/// then as it was before and nothing is left beside it. The folder must exist.
void writeFileAtomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
void writeFileAtomically(const std::filesystem::path& path, std::string_view text);

/// From now on no half-written file survives SIGINT, SIGTERM or SIGHUP (one of which ends the process as
/// ever). Signals that are ignored stay ignored. For a program's main; a library leaves signals alone.
void removeUnfinishedFilesOnSignals();

/// The bytes of a regular file of at most `limit_bytes`. Throws InputError, naming the path and what to do.
std::vector<std::byte> readWholeFile(const std::filesystem::path& path,
                                     std::size_t limit_bytes = std::size_t(4) << 30);

}  // namespace penumbra::studio
