// SPDX-License-Identifier: Apache-2.0
// From a file's bytes to a JSON document that is safe to walk.
//
// The loader reads the JSON itself and not through tinygltf: that narrows 64-bit integers to 32, leaves out
// primitives and channels that it cannot parse, and refuses sparse indices without a base, so that a check of
// what it returns would come too late, and could not say where in the file a fault is.
#pragma once

#include <filesystem>
#include <optional>

#include "studio/scene/gltf/asset_files.h"
#include "studio/scene/gltf/budget.h"
#include "studio/scene/gltf/place_error.h"

namespace penumbra::studio::gltf {

struct Document {
    nlohmann::json json;
    std::optional<Bytes> binaryChunk;  ///< a GLB's second chunk

    PointerPlaces places;

    JsonView root() const { return {json, "", places}; }
};

/// Reads a .gltf or .glb (told apart by content), checks the container and the version.
/// Nothing within the document is validated yet, but that it nests at most 64 deep.
Document readDocument(const std::filesystem::path& file, Budget& budget);

}  // namespace penumbra::studio::gltf
