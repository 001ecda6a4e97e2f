// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "penumbra/caster.h"
#include "src/geometry/edge_topology.h"
#include "src/gl/buffer.h"

namespace penumbra {

/// The edges of a mesh on the device. They depend on what the mesh was made of, not on how it is deformed:
/// positions that were equal at first are taken to move together.
class EdgeMesh {
  public:
    explicit EdgeMesh(const Mesh& mesh);

    std::size_t edgeCount() const { return edgeCount_; }
    /// The number of edges, where one of more than two faces counts for each pair of them.
    std::size_t pairCount() const { return pairCount_; }
    const gl::Buffer& edges() const { return edges_; }  ///< EdgeTopology::Edge
    const gl::Buffer& faces() const { return faces_; }  ///< EdgeTopology::faces

  private:
    std::size_t edgeCount_, pairCount_ = 0;
    gl::Buffer edges_, faces_;
};

/// The mesh's edges, found at the first call and kept with the mesh for as long as it lives.
const EdgeMesh& edgesOf(const Mesh& mesh);

}  // namespace penumbra
