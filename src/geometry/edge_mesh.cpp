// SPDX-License-Identifier: Apache-2.0
#include "src/geometry/edge_mesh.h"

#include "src/geometry/mesh_internals.h"

namespace penumbra {

EdgeMesh::EdgeMesh(const Mesh& mesh) {
    const EdgeTopology topology = findEdges(mesh.positions(), mesh.indices());
    edgeCount_ = topology.edges.size();
    for (const EdgeTopology::Edge& edge : topology.edges) pairCount_ += (edge.faceCount + 1) / 2;
    edges_ = gl::Buffer(std::as_bytes(std::span(topology.edges)), "mesh edges");
    faces_ = gl::Buffer(std::as_bytes(std::span(topology.faces)), "faces of mesh edges");
}

const EdgeMesh& edgesOf(const Mesh& mesh) {
    Mesh::Internals& internals = internalsOf(mesh);
    if (!internals.edges) internals.edges = std::make_unique<const EdgeMesh>(mesh);
    return *internals.edges;
}

}  // namespace penumbra
