// SPDX-License-Identifier: Apache-2.0
// Buffer views of EXT_meshopt_compression, by meshoptimizer.
#pragma once

#include <cstdint>
#include <span>

#include "studio/scene/gltf/asset_files.h"

namespace penumbra::studio::gltf {

/// What the extension says of a view.
struct MeshoptView {
    enum class Mode { attributes, triangles, indices };
    enum class Filter { none, octahedral, quaternion, exponential };

    std::uint64_t count = 0;       ///< elements
    std::size_t stride_bytes = 0;  ///< of one, decompressed
    Mode mode = Mode::attributes;
    Filter filter = Filter::none;
};

/// Reads the extension's object and checks it against the view that it fills. Throws PlaceError.
MeshoptView readMeshoptView(const JsonView& json, std::uint64_t view_bytes);

/// `count` times `stride_bytes` bytes. Throws PlaceError at `json` where `compressed` is damaged.
Bytes decompress(const MeshoptView& view, std::span<const std::byte> compressed, const JsonView& json,
                 Budget& budget);

}  // namespace penumbra::studio::gltf
