// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/soft_shadow_volumes/caster_clusters.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <string>

namespace penumbra {
namespace {

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
    reserve(triangles_, clusters * clusterTriangles * sizeof(LightTriangle), "soft-volumes/triangles");
    reserve(clusters_, clusters * sizeof(TriangleCluster), "soft-volumes/clusters");
    const glm::ivec4 tiles = frame.constants.tiles;
    const unsigned rows = groupsOf(unsigned(frame.constants.buffer_px.y), unsigned(8 * tiles.z));
    reserve(clusterLists_, std::size_t(rows) * std::size_t(tiles.y) * groupsOf(clusters, 32) * sizeof(uint),
            "soft-volumes/cluster lists");
}

unsigned CasterClusters::add(const SilhouetteSource& source, bool cutsLight, unsigned first) {
    const unsigned added = std::min(countOf(*source.mesh) - first, largestBatch - count_);
    gather_.use();
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, source.mesh->positionBuffer());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, source.mesh->indexBuffer());
    bindStorage(2, triangles_);
    bindStorage(3, clusters_);
    glUniformMatrix4dv(0, 1, GL_FALSE, glm::value_ptr(source.lightFromMesh));
    glUniform1ui(4, GLuint(source.mesh->indices().size() / 3));
    glUniform1i(5, cutsLight);
    glUniform1ui(6, first * clusterTriangles);
    glUniform1ui(7, count_);
    glDispatchCompute(added, 1, 1);
    count_ += added;
    return added;
}

void CasterClusters::list(const VolumeFrame& frame, const gl::Buffer& tileBounds, Towards towards) {
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    lists_.use();
    bind(tileBounds);
    glUniform1ui(0, count_);
    glUniform1i(1, towards == Towards::center);
    const glm::ivec4 tiles = frame.constants.tiles;
    glDispatchCompute(GLuint(tiles.y), groupsOf(unsigned(frame.constants.buffer_px.y), unsigned(8 * tiles.z)), 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void CasterClusters::bind(const gl::Buffer& tileBounds) const {
    bindStorage(0, tileBounds);
    bindStorage(1, clusters_);
    bindStorage(2, triangles_);
    bindStorage(3, clusterLists_);
}

std::size_t CasterClusters::size_bytes() const {
    return triangles_.size_bytes() + clusters_.size_bytes() + clusterLists_.size_bytes();
}

}  // namespace penumbra
