// SPDX-License-Identifier: Apache-2.0
#include "src/geometry/silhouette_extractor.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <string>
#include <string_view>

#include "src/geometry/edge_mesh.h"

namespace penumbra {
namespace {

constexpr std::size_t blockSize = 256;
constexpr std::size_t wordsPerBlock = blockSize / 32;
constexpr std::size_t largestDispatch = 65535;  // guaranteed to every OpenGL 4.5 program

std::size_t blocksFor(std::size_t count) {
    return (count + blockSize - 1) / blockSize;
}

/// Runs the current program with one invocation for each of `count` things.
void dispatch(std::size_t count) {
    if (count > 0) glDispatchCompute(GLuint(blocksFor(count)), 1, 1);
}

void reserve(gl::Buffer& buffer, std::size_t size_bytes, std::string_view label) {
    if (buffer.name() == 0 || buffer.size_bytes() < size_bytes) buffer = gl::Buffer(size_bytes, label);
}

void bindStorage(GLuint block, GLuint buffer) {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, block, buffer);
}

void require(std::size_t count, std::string_view things) {
    if (blocksFor(count) > largestDispatch) {
        throw Error(Error::Kind::badArgument, "a mesh of " + std::to_string(count) + " " +
                                                  std::string(things) +
                                                  " is more than silhouettes can be found of (" +
                                                  std::to_string(largestDispatch * blockSize) + ")");
    }
}

}  // namespace

SilhouetteExtractor::SilhouetteExtractor(Device& device)
    : facing_(device.internals().shaders, {"src/geometry/facing.comp.glsl"}),
      mark_(device.internals().shaders, {"src/geometry/silhouette_mark.comp.glsl"}),
      scan_(device.internals().shaders, {"src/geometry/silhouette_scan.comp.glsl"}),
      write_(device.internals().shaders, {"src/geometry/silhouette_write.comp.glsl"}),
      commands_(sizeof(SilhouetteCommands), "silhouette commands") {}

void SilhouetteExtractor::extract(std::span<const SilhouetteSource> sources, const LightPoint& point,
                                  DrawShape shape) {
    std::size_t triangleCount = 0, blockCount = 0;
    edgeCount_ = 0;
    for (const SilhouetteSource& source : sources) {
        const std::size_t edges = edgesOf(*source.mesh).edgeCount();
        require(edges, "edges");
        require(source.mesh->indices().size() / 3, "triangles");
        triangleCount += source.mesh->indices().size() / 3;
        edgeCount_ += edges;
        blockCount += blocksFor(edges);
    }
    reserve(facings_, triangleCount * sizeof(int), "triangle facings");
    reserve(marks_, blockCount * wordsPerBlock * sizeof(uint), "silhouette marks");
    reserve(offsets_, blockCount * sizeof(uint), "silhouette offsets");
    reserve(silhouettes_, edgeCount_ * sizeof(SilhouetteEdge), "silhouette edges");

    // Which triangles show their front.
    facing_.use();
    bindFacings(2);
    std::size_t firstFacing = 0;
    for (const SilhouetteSource& source : sources) {
        const std::size_t triangles = source.mesh->indices().size() / 3;
        bindStorage(0, source.mesh->positionBuffer());
        bindStorage(1, source.mesh->indexBuffer());
        glUniform4fv(0, 1, glm::value_ptr(lightPointInMesh(source.lightFromMesh, point)));
        glUniform1ui(1, GLuint(triangles));
        glUniform1ui(2, GLuint(firstFacing));
        dispatch(triangles);
        firstFacing += triangles;
    }
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);

    const auto forEachMesh = [&](auto&& dispatchMesh) {
        std::size_t facing = 0, block = 0;
        for (std::size_t i = 0; i < sources.size(); ++i) {
            const EdgeMesh& edges = edgesOf(*sources[i].mesh);
            bindStorage(1, edges.edges().name());
            bindStorage(2, edges.faces().name());
            glUniform1ui(0, GLuint(edges.edgeCount()));
            glUniform1ui(1, GLuint(facing));
            glUniform1ui(2, GLuint(block));
            dispatchMesh(i, edges.edgeCount());
            facing += sources[i].mesh->indices().size() / 3;
            block += blocksFor(edges.edgeCount());
        }
    };

    // Which edges are silhouettes.
    mark_.use();
    bindFacings(3);
    bindStorage(4, marks_.name());
    forEachMesh([](std::size_t, std::size_t edges) { dispatch(edges); });
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);

    // Where they go in the list, and how many they are.
    scan_.use();
    bindStorage(0, marks_.name());
    bindStorage(1, offsets_.name());
    bindStorage(2, commands_.name());
    glUniform1ui(0, GLuint(blockCount));
    glUniform1ui(1, shape.verticesPerEdge);
    glUniform1ui(2, shape.instances);
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);

    // The list.
    write_.use();
    bindFacings(3);
    bindStorage(4, marks_.name());
    bindStorage(5, offsets_.name());
    bindEdges(6);
    vertexCount_ = 0;
    forEachMesh([&](std::size_t i, std::size_t edges) {
        bindStorage(0, sources[i].mesh->positionBuffer());
        glUniformMatrix4fv(3, 1, GL_FALSE, glm::value_ptr(glm::mat4(sources[i].lightFromMesh)));
        glUniform1ui(4, GLuint(i));
        glUniform1ui(5, GLuint(vertexCount_));
        vertexCount_ += sources[i].mesh->positions().size();
        dispatch(edges);
    });
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void SilhouetteExtractor::bindEdges(unsigned block) const {
    bindStorage(block, silhouettes_.name());
}

void SilhouetteExtractor::bindFacings(unsigned block) const {
    bindStorage(block, facings_.name());
}

unsigned SilhouetteExtractor::countFound() const {
    SilhouetteCommands commands{};
    if (edgeCount_ > 0) commands_.read(std::as_writable_bytes(std::span(&commands, 1)));
    return commands.edgeCount;
}

}  // namespace penumbra
