// SPDX-License-Identifier: Apache-2.0
// Which triangles meet at which edge, for any triangle soup: open, non-manifold, wound at random.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "penumbra/math.h"

namespace penumbra {

/// The edges of a mesh whose positions have been welded where they are equal bit for bit (0 and -0 are one).
struct EdgeTopology {
    struct Edge {
        std::uint32_t a, b;       ///< indices of positions, each the first of those welded with it; a < b
        std::uint32_t firstFace;  ///< into `faces`
        std::uint32_t faceCount;  ///< >= 1; 2 in a closed mesh
    };
    std::vector<Edge> edges;  ///< ordered by a, then b
    /// For each edge its faces: the triangle's number times two, plus one where the triangle walks from b to
    /// a.
    std::vector<std::uint32_t> faces;
};

/// Triangles that welding collapses to an edge or a point have no edges here. Three corners on one line are a
/// triangle like others: a mesh that stitches its cracks with such slivers stays closed.
EdgeTopology findEdges(std::span<const Vec3> positions, std::span<const std::uint32_t> indices);

}  // namespace penumbra
