// SPDX-License-Identifier: Apache-2.0
// From a file's bytes to a JSON document that is safe to walk.
#pragma once

#include <filesystem>
#include <optional>

#include "studio/scene/gltf/asset_files.h"
#include "studio/scene/gltf/budget.h"

namespace penumbra::studio::gltf {

struct Document {
    nlohmann::json json;
    std::optional<Bytes> binaryChunk;  ///< a GLB's second chunk

    JsonView root() const { return {json, ""}; }
};

bool isSupportedExtension(const std::string& name);

/// Reads a .gltf or .glb (told apart by content), checks the container, the version and extensionsRequired.
/// Nothing within the document is validated yet, but that it nests at most 64 deep.
Document readDocument(const std::filesystem::path& file, Budget& budget);

}  // namespace penumbra::studio::gltf
