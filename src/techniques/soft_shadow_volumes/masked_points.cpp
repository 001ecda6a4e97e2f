// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/soft_shadow_volumes/masked_points.h"

#include <algorithm>
#include <string>

namespace penumbra::soft_shadow_volumes {
namespace {

constexpr int pointsAWord = 32;

/// So few that a software rasterizer does all that it is asked, were every point asked about every triangle
/// (README.md, "Rounds").
unsigned clustersOfAGroup(int samples) {
    return std::max(1u, 32768u / (clusterTriangles * unsigned(samples)));
}

}  // namespace

void MaskedPoints::fitHidden(glm::ivec2 size_px, int words) {
    hidden_.fit({.width_px = size_px.x,
                 .height_px = size_px.y,
                 .layers = words,
                 .format = gl::Format::r32ui,
                 .label = "soft-volumes/points hidden by masks"});
}

void MaskedPoints::allocate(glm::ivec2 size_px, int samples) {
    fitHidden(size_px, (samples + pointsAWord - 1) / pointsAWord);
    if (markSamples_ == samples) return;
    mark_ = gl::Program(device_.shaders, {"src/techniques/soft_shadow_volumes/masked_points.comp.glsl"},
                        {"SAMPLES " + std::to_string(samples),
                         "CLUSTERS_AT_ONCE " + std::to_string(clustersOfAGroup(samples))});
    markSamples_ = samples;
}

void MaskedPoints::mark(const VolumeFrame& frame, const FrameBinding& binding, CasterClusters& clusters,
                        const LightPoints& points, const Receivers& receivers) {
    // Without any, passes still have something to bind.
    if (frame.masked.empty()) {
        if (hidden_.name() == 0) fitHidden(glm::ivec2(1), 1);
        return;
    }
    allocate(frame.constants.buffer_px, points.count());
    hidden_.clear();
    const VolumeConstants& constants = frame.constants;
    const unsigned each = clustersOfAGroup(points.count());
    for (const MaskedSource& masked : frame.masked) {
        const Mesh& mesh = *masked.source.mesh;
        for (unsigned done = 0; done < CasterClusters::countOf(mesh);) {
            MeshConstants part{};
            part.lightFromMesh = masked.source.lightFromMesh;
            part.count = uint(mesh.indices().size() / 3);
            part.firstTriangle = done * clusterTriangles;
            clusters.clear();
            const unsigned added = clusters.add(binding, mesh, part);
            clusters.list(frame, binding, receivers.tileBounds, CasterClusters::Towards::light);
            gl::Pass(mark_)
                .constants(ClusterConstants{.count = added,
                                            .toCenter = false,
                                            .firstTriangle = part.firstTriangle,
                                            .alphaFactor = masked.mask.factor,
                                            .alphaCutoff = masked.mask.cutoff})
                .bind(binding)
                .bind(clusters)
                .bind(receivers)
                .bind(points)
                .bind("Indices", gl::HostBuffer{mesh.indexBuffer()})
                .bind("Uvs", gl::HostBuffer{mesh.uvBuffer()})
                .bind("alphaTexture", gl::TextureRef{.name = masked.mask.texture})
                .bind("hiddenPoints", hidden_)
                .dispatch(constants.smallTilesAcross, std::size_t(constants.buffer_px.y + 7) / 8,
                          (added + each - 1) / each);
            done += added;
        }
    }
    clusters.clear();
}

}  // namespace penumbra::soft_shadow_volumes
