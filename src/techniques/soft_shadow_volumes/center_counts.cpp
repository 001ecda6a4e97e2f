// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/soft_shadow_volumes/center_counts.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <string>

namespace penumbra {
namespace {

/// Triangles are looked at in batches of so many clusters at most: 64 MiB of them.
constexpr unsigned largestBatch = (64u << 20) / (clusterTriangles * sizeof(LightTriangle));

gl::Program program(Device& device, std::string_view name) {
    return {device.internals().shaders,
            {"src/techniques/soft_shadow_volumes/" + std::string(name) + ".comp.glsl"}};
}

void reserve(gl::Buffer& buffer, std::size_t size_bytes, std::string_view label) {
    if (buffer.name() != 0 && buffer.size_bytes() >= size_bytes) return;
    buffer = {};
    buffer = gl::Buffer(size_bytes, label);
}

void bindStorage(GLuint block, const gl::Buffer& buffer) {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, block, buffer.name());
}

unsigned groupsOf(unsigned count, unsigned each) {
    return (count + each - 1) / each;
}

unsigned trianglesOf(const SilhouetteSource& source) {
    return unsigned(source.mesh->indices().size() / 3);
}

}  // namespace

CenterCounts::CenterCounts(Device& device)
    : gather_(program(device, "center_gather")),
      lists_(program(device, "center_lists")),
      count_(program(device, "center_counts")) {}

void CenterCounts::allocate(const VolumeFrame& frame) {
    const VolumeConstants& constants = frame.constants;
    unsigned clusters = 0;
    for (const SilhouetteSource& source : frame.sources)
        clusters += groupsOf(trianglesOf(source), clusterTriangles);
    clusters = std::min(clusters, largestBatch);
    reserve(triangles_, clusters * clusterTriangles * sizeof(LightTriangle), "soft-volumes/triangles");
    reserve(clusters_, clusters * sizeof(TriangleCluster), "soft-volumes/clusters");
    const glm::ivec4 tiles = constants.tiles;
    const std::size_t rows = std::size_t((constants.buffer_px.y + 8 * tiles.z - 1) / (8 * tiles.z));
    reserve(clusterLists_, rows * std::size_t(tiles.y) * groupsOf(clusters, 32) * sizeof(uint),
            "soft-volumes/cluster lists");
    const glm::ivec2 size_px(constants.buffer_px);
    if (counts_.name() == 0 || counts_.width_px() != size_px.x || counts_.height_px() != size_px.y) {
        counts_ = {};
        counts_ = gl::Texture({.width_px = size_px.x,
                               .height_px = size_px.y,
                               .format = GL_R32I,
                               .label = "soft-volumes/layers at the centre"});
    }
}

void CenterCounts::countBatch(const VolumeFrame& frame, const gl::Buffer& tileBounds, unsigned clusters) {
    const glm::ivec4 tiles = frame.constants.tiles;
    const int rows = (frame.constants.buffer_px.y + 7) / 8;
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    bindStorage(0, tileBounds);
    bindStorage(1, clusters_);
    bindStorage(2, triangles_);
    bindStorage(3, clusterLists_);
    lists_.use();
    glUniform1ui(0, clusters);
    glDispatchCompute(GLuint(tiles.y), groupsOf(GLuint(rows), GLuint(tiles.z)), 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    count_.use();
    counts_.bindImage(0, GL_READ_WRITE);
    glUniform1ui(0, clusters);
    glDispatchCompute(GLuint(tiles.x), GLuint(rows), groupsOf(clusters, clustersAtOnce));
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                    GL_SHADER_STORAGE_BARRIER_BIT);
}

void CenterCounts::count(const VolumeFrame& frame, const gl::Buffer& tileBounds, const gl::Texture& depth) {
    allocate(frame);
    const int none = 0;
    glClearTexImage(counts_.name(), 0, GL_RED_INTEGER, GL_INT, &none);
    depth.bind(4);
    unsigned inBatch = 0;
    for (std::size_t i = 0; i < frame.sources.size(); ++i) {
        const SilhouetteSource& source = frame.sources[i];
        const unsigned clusters = groupsOf(trianglesOf(source), clusterTriangles);
        for (unsigned first = 0; first < clusters;) {
            const unsigned fitting = std::min(clusters - first, largestBatch - inBatch);
            gather_.use();
            glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, source.mesh->positionBuffer());
            glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, source.mesh->indexBuffer());
            bindStorage(2, triangles_);
            bindStorage(3, clusters_);
            glUniformMatrix4dv(0, 1, GL_FALSE, glm::value_ptr(source.lightFromMesh));
            glUniform1ui(4, trianglesOf(source));
            glUniform1i(5, frame.cutsLight[i]);
            glUniform1ui(6, first * clusterTriangles);
            glUniform1ui(7, inBatch);
            glDispatchCompute(fitting, 1, 1);
            first += fitting;
            inBatch += fitting;
            if (inBatch < largestBatch) continue;
            countBatch(frame, tileBounds, inBatch);
            inBatch = 0;
        }
    }
    if (inBatch > 0) countBatch(frame, tileBounds, inBatch);
}

std::size_t CenterCounts::size_bytes() const {
    return triangles_.size_bytes() + clusters_.size_bytes() + clusterLists_.size_bytes();
}

}  // namespace penumbra
