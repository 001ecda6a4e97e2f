// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/soft_shadow_volumes/center_counts.h"

namespace penumbra {

CenterCounts::CenterCounts(Device& device)
    : count_(device.internals().shaders, {"src/techniques/soft_shadow_volumes/center_counts.comp.glsl"}) {}

void CenterCounts::countBatch(const VolumeFrame& frame, CasterClusters& clusters, const gl::Buffer& tileBounds) {
    clusters.list(frame, tileBounds, CasterClusters::Towards::center);
    count_.use();
    clusters.bind(tileBounds);
    counts_.bindImage(0, GL_READ_WRITE);
    glUniform1ui(0, clusters.count());
    const int rows = (frame.constants.buffer_px.y + 7) / 8;
    const unsigned parts = (clusters.count() + clustersAtOnce - 1) / clustersAtOnce;
    glDispatchCompute(GLuint(frame.constants.tiles.x), GLuint(rows), parts);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                    GL_SHADER_STORAGE_BARRIER_BIT);
    clusters.clear();
}

void CenterCounts::count(const VolumeFrame& frame, CasterClusters& clusters, const gl::Buffer& tileBounds,
                         const gl::Texture& depth) {
    const glm::ivec2 size_px(frame.constants.buffer_px);
    if (counts_.name() == 0 || counts_.width_px() != size_px.x || counts_.height_px() != size_px.y) {
        counts_ = {};
        counts_ = gl::Texture({.width_px = size_px.x,
                               .height_px = size_px.y,
                               .format = GL_R32I,
                               .label = "soft-volumes/layers at the centre"});
    }
    const int none = 0;
    glClearTexImage(counts_.name(), 0, GL_RED_INTEGER, GL_INT, &none);
    depth.bind(4);
    clusters.clear();
    for (std::size_t i = 0; i < frame.sources.size(); ++i) {
        const unsigned ofSource = CasterClusters::countOf(*frame.sources[i].mesh);
        for (unsigned first = 0; first < ofSource;) {
            first += clusters.add(frame.sources[i], frame.cutsLight[i], first);
            if (clusters.isFull()) countBatch(frame, clusters, tileBounds);
        }
    }
    if (clusters.count() > 0) countBatch(frame, clusters, tileBounds);
}

}  // namespace penumbra
