// SPDX-License-Identifier: Apache-2.0
// The only code of the loader that opens files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "studio/scene/gltf/budget.h"
#include "studio/scene/gltf/place_error.h"

namespace penumbra::studio::gltf {

using Bytes = std::vector<std::byte>;

inline constexpr std::uint64_t maxFile_bytes = 2ull << 30;

/// The whole of a regular file of at most maxFile_bytes; `place` is where the file is mentioned.
Bytes readFile(const std::filesystem::path& path, Budget& budget, const std::string& place);

/// What a `uri` property names: the content of a data URI, or of a regular file beneath `folder`.
/// Percent-decoded once; anything absolute, with a scheme, with "..", or that leaves the folder by a symbolic
/// link is refused: MissingFile, as for what is not there.
Bytes readUri(const JsonView& uri, const std::filesystem::path& folder, Budget& budget);

}  // namespace penumbra::studio::gltf
