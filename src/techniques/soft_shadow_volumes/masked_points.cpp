// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/soft_shadow_volumes/masked_points.h"

#include <algorithm>
#include <string>

namespace penumbra {
namespace {

constexpr int pointsAWord = 32;

/// So few that a software rasterizer does all that it is asked, were every point asked about every triangle
/// (README.md, "Rounds").
unsigned clustersOfAGroup(int samples) {
    return std::max(1u, 32768u / (clusterTriangles * unsigned(samples)));
}

}  // namespace

void MaskedPoints::allocate(glm::ivec2 size_px, int samples) {
    const int words = (samples + pointsAWord - 1) / pointsAWord;
    if (hidden_.name() == 0 || hidden_.width_px() != size_px.x || hidden_.height_px() != size_px.y ||
        hidden_.layers() != words) {
        hidden_ = {};
        hidden_ = gl::Texture({.width_px = size_px.x,
                               .height_px = size_px.y,
                               .layers = words,
                               .format = GL_R32UI,
                               .label = "soft-volumes/points hidden by masks"});
    }
    if (markSamples_ == samples) return;
    mark_ = gl::Program(device_.shaders, {"src/techniques/soft_shadow_volumes/masked_points.comp.glsl"},
                        {"SAMPLES " + std::to_string(samples),
                         "CLUSTERS_AT_ONCE " + std::to_string(clustersOfAGroup(samples))});
    markSamples_ = samples;
}

void MaskedPoints::mark(const VolumeFrame& frame, CasterClusters& clusters, const LightPoints& points,
                        const gl::Buffer& tileBounds, const gl::Texture& depth) {
    if (frame.masked.empty()) return;
    allocate(glm::ivec2(frame.constants.buffer_px), points.count());
    const GLuint none = 0;
    glClearTexImage(hidden_.name(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT, &none);
    depth.bind(4);
    const GLuint rows = GLuint(frame.constants.buffer_px.y + 7) / 8;
    for (const MaskedSource& masked : frame.masked) {
        const Mesh& mesh = *masked.source.mesh;
        for (unsigned first = 0; first < CasterClusters::countOf(mesh);) {
            clusters.clear();
            const unsigned added = clusters.add(masked.source, false, first);
            clusters.list(frame, tileBounds, CasterClusters::Towards::light);
            mark_.use();
            clusters.bind(tileBounds);
            points.bind();
            glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 6, mesh.indexBuffer());
            glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 7, mesh.uvBuffer());
            glBindTextureUnit(6, masked.mask.texture);
            hidden_.bindImage(0, GL_READ_WRITE);
            glUniform1ui(0, added);
            glUniform1ui(1, first * clusterTriangles);
            glUniform2f(2, masked.mask.factor, masked.mask.cutoff);
            const unsigned each = clustersOfAGroup(points.count());
            glDispatchCompute(GLuint(frame.constants.tiles.x), rows, (added + each - 1) / each);
            glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                            GL_TEXTURE_FETCH_BARRIER_BIT);
            first += added;
        }
    }
    clusters.clear();
}

}  // namespace penumbra
