// SPDX-License-Identifier: Apache-2.0
// Reads glTF 2.0 (.gltf and .glb) from files that nobody vouches for.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "studio/scene/scene.h"

namespace penumbra::studio {

struct GltfOptions {
    std::optional<int> scene;  ///< which of the file's scenes; the file's own default where unset
    /// Which animations play together, looping over the longest; none: the rest pose. Unset: all but those
    /// that would move what an earlier one moves.
    std::optional<std::vector<int>> animations;
    Glass glass = Glass::clear;
    double unit_m = 1;  ///< the length that the file's coordinates count
    UpAxis up = UpAxis::y;
    std::uint64_t memoryBudget_bytes = 4ull << 30;  ///< for everything that loading allocates
};

/// Loads meshes, materials, skins, morph targets, animations, cameras and lights.
///
/// Extensions, and what becomes of those that are not read: docs/manual/files.md. `extras.penumbra` is read
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
