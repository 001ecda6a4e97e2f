// SPDX-License-Identifier: Apache-2.0
// Files that another file names: pictures and profiles of lights, tilt factors of profiles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace penumbra::studio {

/// The whole of a regular file. Throws InputError "WHERE: 'FILE' ..." where there is none, where it is larger
/// than `limit_bytes` and where it cannot be read.
std::vector<std::byte> readWholeFile(const std::filesystem::path& file, std::uintmax_t limit_bytes,
                                     const std::string& where);

/// A file beneath `folder`, whatever the text tries: no absolute path, no "..", no link that leads out.
/// Throws InputError "WHAT must be ..."; the file itself need not exist.
std::filesystem::path fileBeneath(const std::filesystem::path& folder, const std::string& text,
                                  const std::string& what);

}  // namespace penumbra::studio
