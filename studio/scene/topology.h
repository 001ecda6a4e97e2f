// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace penumbra::studio {

/// How the triangles of a mesh hang together once vertices at equal positions (-0 equals 0) are welded.
struct Topology {
    std::size_t triangles = 0;         ///< as given
    std::size_t vertices = 0;          ///< as given
    std::size_t weldedVertices = 0;    ///< different positions
    std::size_t edges = 0;             ///< of triangles that are not degenerate
    std::size_t boundaryEdges = 0;     ///< used by one triangle
    std::size_t nonManifoldEdges = 0;  ///< used by three or more
    /// Used by two that walk it in the same direction: their windings disagree
    std::size_t flippedEdges = 0;
    std::size_t degenerateTriangles = 0;  ///< with two corners at one position; not counted into the edges

    /// Every edge joins exactly two triangles. True of nothing at all.
    bool closed() const { return boundaryEdges == 0 && nonManifoldEdges == 0; }
};

/// Analyzes a triangle list. `indices` must be below the number of positions; a last incomplete triple is
/// ignored. Sorting makes the result independent of any hash and the cost n log n.
Topology analyzeTopology(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices);

}  // namespace penumbra::studio
