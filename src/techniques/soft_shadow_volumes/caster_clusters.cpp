// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/soft_shadow_volumes/caster_clusters.h"

#include <algorithm>
#include <string>

namespace penumbra::soft_shadow_volumes {
namespace {

gl::Program program(Device& device, std::string_view name) {
    return {internalsOf(device).shaders,
            {"src/techniques/soft_shadow_volumes/" + std::string(name) + ".comp.glsl"}};
}

unsigned groupsOf(unsigned count, unsigned each) {
    return (count + each - 1) / each;
}

}  // namespace

CasterClusters::CasterClusters(Device& device)
    : gather_(program(device, "cluster_gather")), lists_(program(device, "cluster_lists")) {}

unsigned CasterClusters::countOf(const Mesh& mesh) {
    return groupsOf(unsigned(mesh.indices().size() / 3), clusterTriangles);
}

void CasterClusters::allocate(const VolumeFrame& frame) {
    unsigned clusters = 0;
    for (const SilhouetteSource& source : frame.sources)
        clusters = std::min(clusters + countOf(*source.mesh), largestBatch);
    for (const MaskedSource& masked : frame.masked)
        clusters = std::max(clusters, std::min(countOf(*masked.source.mesh), largestBatch));
    triangles_.reserve(clusters * clusterTriangles * sizeof(LightTriangle), "soft-volumes/triangles");
    clusters_.reserve(clusters * sizeof(TriangleCluster), "soft-volumes/clusters");
    const unsigned rows =
        groupsOf(unsigned(frame.constants.buffer_px.y), 8 * frame.constants.smallTilesALargeOne);
    const std::size_t words = groupsOf(clusters, 32);
    clusterLists_.reserve(rows * frame.constants.largeTilesAcross * words * sizeof(uint),
                          "soft-volumes/cluster lists");
}

unsigned CasterClusters::add(const FrameBinding& binding, const Mesh& mesh, const MeshConstants& part) {
    MeshConstants constants = part;
    const unsigned first = constants.firstTriangle / clusterTriangles;
    const unsigned added = std::min(countOf(mesh) - first, largestBatch - count_);
    constants.firstCluster = count_;
    gl::Pass pass(gather_);
    bindMesh(pass, mesh);
    pass.constants(constants)
        .bind(binding)
        .bind("Triangles", triangles_)
        .bind("Clusters", clusters_)
        .dispatch(added);
    count_ += added;
    return added;
}

void CasterClusters::list(const VolumeFrame& frame, const FrameBinding& binding, const gl::Buffer& tileBounds,
                          Towards towards) {
    const VolumeConstants& constants = frame.constants;
    ClusterConstants listed{};
    listed.count = count_;
    listed.toCenter = towards == Towards::center;
    gl::Pass(lists_)
        .constants(listed)
        .bind(binding)
        .bind("Bounds", tileBounds)
        .bind("Clusters", clusters_)
        .bind("Lists", clusterLists_)
        .dispatch(constants.largeTilesAcross,
                  groupsOf(unsigned(constants.buffer_px.y), 8 * constants.smallTilesALargeOne));
}

void CasterClusters::bindTo(gl::Pass& pass) const {
    pass.bind("Clusters", clusters_).bind("Triangles", triangles_).bind("Lists", clusterLists_);
}

std::size_t CasterClusters::size_bytes() const {
    return triangles_.size_bytes() + clusters_.size_bytes() + clusterLists_.size_bytes();
}

}  // namespace penumbra::soft_shadow_volumes
