// SPDX-License-Identifier: Apache-2.0
// Reads glTF 2.0 (.gltf and .glb) from files that nobody vouches for.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "studio/scene/scene.h"

namespace penumbra::studio {

struct GltfOptions {
    std::optional<int> scene;  ///< which of the file's scenes; the file's own default where unset
    int animation = 0;         ///< which clip plays, looping over its duration; -1: the rest pose
    std::uint64_t memoryBudget_bytes = 4ull << 30;  ///< for everything that loading allocates
};

/// Loads meshes, materials, skins, morph targets, one animation, cameras and lights.
///
/// Extensions: KHR_mesh_quantization, KHR_texture_transform, KHR_materials_unlit, KHR_lights_punctual and the
/// draft EXT_lights_area, which replaces KHR_lights_punctual where a file has both. `extras.penumbra` is read
/// on nodes
/// (`casts`, `receives`: booleans) and on punctual lights or their nodes, the node first (`radius`: metres of
/// a point or spot light; `angle`: degrees of a directional one); without it these lights have size zero.
///
/// Where a node mirrors (determinant below zero), indices keep the file's order: the winding flips with the
/// matrix. Buffers and pictures are read from beneath the file's own folder only.
///
/// Throws InputError naming file, JSON pointer and remedy for whatever is wrong with the file; no other
/// exception leaves, here or from Scene::at. Oddities that can be drawn all the same go to Scene::warnings.
Scene loadGltf(const std::filesystem::path& file, const GltfOptions& options = {});

}  // namespace penumbra::studio
