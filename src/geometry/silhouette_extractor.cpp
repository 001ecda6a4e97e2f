// SPDX-License-Identifier: Apache-2.0
#include "src/geometry/silhouette_extractor.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "src/geometry/edge_mesh.h"
#include "src/gl/pass.h"

namespace penumbra {
namespace {

constexpr std::size_t blockSize = 256;
constexpr std::size_t wordsPerBlock = blockSize / 32;
constexpr std::size_t largestDispatch = 65535;  // guaranteed to every OpenGL 4.5 program

std::size_t blocksFor(std::size_t count) {
    return (count + blockSize - 1) / blockSize;
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
    : facing_(internalsOf(device).shaders, {"src/geometry/facing.comp.glsl"}),
      mark_(internalsOf(device).shaders, {"src/geometry/silhouette_mark.comp.glsl"}),
      scan_(internalsOf(device).shaders, {"src/geometry/silhouette_scan.comp.glsl"}),
      write_(internalsOf(device).shaders, {"src/geometry/silhouette_write.comp.glsl"}),
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
    facings_.reserve(triangleCount * sizeof(int), "triangle facings");
    marks_.reserve(blockCount * wordsPerBlock * sizeof(uint), "silhouette marks");
    offsets_.reserve(blockCount * sizeof(uint), "silhouette offsets");
    silhouettes_.reserve(edgeCount_ * sizeof(SilhouetteEdge), "silhouette edges");
    findFacings(sources, point);

    const auto forEachMesh = [&](gl::Pass& pass, auto&& bindMore) {
        SilhouetteConstants constants{};
        for (std::size_t i = 0; i < sources.size(); ++i) {
            const EdgeMesh& edges = edgesOf(*sources[i].mesh);
            constants.lightFromMesh = sources[i].lightFromMesh;
            constants.edgeCount = uint(edges.edgeCount());
            constants.caster = uint(i);
            if (edges.edgeCount() > 0) {
                pass.constants(constants).bind("Edges", edges.edges()).bind("EdgeFaces", edges.faces());
                bindMore(*sources[i].mesh);
                pass.dispatch(blocksFor(edges.edgeCount()));
            }
            constants.firstFacing += uint(sources[i].mesh->indices().size() / 3);
            constants.firstBlock += uint(blocksFor(edges.edgeCount()));
            constants.firstVertex += uint(sources[i].mesh->positions().size());
        }
        vertexCount_ = constants.firstVertex;
    };

    // Which edges are silhouettes.
    {
        gl::Pass pass(mark_);
        pass.bind("Facings", facings_).bind("Marks", marks_);
        forEachMesh(pass, [](const Mesh&) {});
    }
    // Where they go in the list, and how many they are.
    gl::Pass(scan_)
        .constants(ScanConstants{.blockCount = uint(blockCount),
                                 .verticesPerEdge = shape.verticesPerEdge,
                                 .instances = shape.instances})
        .bind("Marks", marks_)
        .bind("Offsets", offsets_)
        .bind("Commands", commands_)
        .dispatch(1);
    // The list.
    gl::Pass pass(write_);
    pass.bind("Facings", facings_)
        .bind("Marks", marks_)
        .bind("Offsets", offsets_)
        .bind("Silhouettes", silhouettes_);
    forEachMesh(pass,
                [&](const Mesh& mesh) { pass.bind("Positions", gl::HostBuffer{mesh.positionBuffer()}); });
}

void SilhouetteExtractor::findFacings(std::span<const SilhouetteSource> sources, const LightPoint& point) {
    gl::Pass pass(facing_);
    pass.bind("Facings", facings_);
    uint firstFacing = 0;
    for (const SilhouetteSource& source : sources) {
        const uint triangles = uint(source.mesh->indices().size() / 3);
        pass.constants(FacingConstants{.lightMesh = lightPointInMesh(source.lightFromMesh, point),
                                       .triangleCount = triangles,
                                       .firstFacing = firstFacing})
            .bind("Positions", gl::HostBuffer{source.mesh->positionBuffer()})
            .bind("Indices", gl::HostBuffer{source.mesh->indexBuffer()});
        pass.dispatch(blocksFor(triangles));
        firstFacing += triangles;
    }
}

unsigned SilhouetteExtractor::countFound() const {
    SilhouetteCommands commands{};
    if (edgeCount_ > 0) commands_.read(std::as_writable_bytes(std::span(&commands, 1)));
    return commands.edgeCount;
}

}  // namespace penumbra
