// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/soft_shadow_volumes/center_counts.h"

namespace penumbra::soft_shadow_volumes {

CenterCounts::CenterCounts(Device& device)
    : count_(internalsOf(device).shaders, {"src/techniques/soft_shadow_volumes/center_counts.comp.glsl"}) {}

void CenterCounts::countBatch(const VolumeFrame& frame, const FrameBinding& binding, CasterClusters& clusters,
                              const Receivers& receivers) {
    clusters.list(frame, binding, receivers.tileBounds, CasterClusters::Towards::center);
    const VolumeConstants& constants = frame.constants;
    ClusterConstants listed{};
    listed.count = clusters.count();
    gl::Pass(count_)
        .constants(listed)
        .bind(binding)
        .bind(clusters)
        .bind(receivers)
        .bind("centerCounts", counts_)
        .dispatch(constants.smallTilesAcross, std::size_t(constants.buffer_px.y + 7) / 8,
                  (clusters.count() + clustersAtOnce - 1) / clustersAtOnce);
    clusters.clear();
}

void CenterCounts::count(const VolumeFrame& frame, const FrameBinding& binding, CasterClusters& clusters,
                         const Receivers& receivers) {
    counts_.fit({.width_px = frame.constants.buffer_px.x,
                 .height_px = frame.constants.buffer_px.y,
                 .format = gl::Format::r32ui,
                 .label = "soft-volumes/layers at the centre"});
    counts_.clear();
    clusters.clear();
    for (std::size_t i = 0; i < frame.sources.size(); ++i) {
        const Mesh& mesh = *frame.sources[i].mesh;
        MeshConstants constants = meshConstants(frame, i, mesh.indices().size() / 3);
        for (unsigned added = 0; added < CasterClusters::countOf(mesh);) {
            constants.firstTriangle = added * clusterTriangles;
            added += clusters.add(binding, mesh, constants);
            if (clusters.isFull()) countBatch(frame, binding, clusters, receivers);
        }
    }
    if (clusters.count() > 0) countBatch(frame, binding, clusters, receivers);
}

}  // namespace penumbra::soft_shadow_volumes
