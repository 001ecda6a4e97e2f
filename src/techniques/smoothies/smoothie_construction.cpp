// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/smoothies/smoothie_construction.h"

#include "src/techniques/smoothies/smoothie_edges_io.h"

namespace penumbra::smoothies {

void SurfaceMaps::bindTo(gl::Pass& pass) const {
    pass.bind("depthMaps", casters.texture())
        .bind("receiverMaps", hasReceivers ? receivers.texture().ref() : gl::TextureRef{});
}

SmoothieConstruction::SmoothieConstruction(Device& device)
    : farthest_(internalsOf(device).shaders, {"src/techniques/smoothies/farthest.comp.glsl"}),
      build_(internalsOf(device).shaders, {"src/techniques/smoothies/smoothie_edges.comp.glsl"}),
      clearNormals_(internalsOf(device).shaders, {"src/techniques/smoothies/vertex_normals.comp.glsl"},
                    {"CLEAR"}),
      addNormals_(internalsOf(device).shaders, {"src/techniques/smoothies/vertex_normals.comp.glsl"}) {}

void SmoothieConstruction::build(const SilhouetteExtractor& silhouettes, const SurfaceMaps& surfaces,
                                 const gl::Buffer& constants, bool isDistant) {
    const auto cameras = std::size_t(surfaces.casters.count());
    farthestTiles_.reserve(cameras * tilesAcross * tilesAcross * sizeof(float), "smoothies/farthest");
    vertexNormals_.reserve(silhouettes.vertexCount() * sizeof(glm::ivec4), "smoothies/vertex normals");
    smoothieEdges_.reserve(cameras * silhouettes.edgeCount() * sizeof(SmoothieEdge), "smoothies/edges");
    const ConstructionConstants construction{.hasReceiverMaps = surfaces.hasReceivers,
                                             .isDistant = isDistant,
                                             .cameraCount = int(cameras),
                                             .drawnCamera = 0,
                                             .capacity = glm::uint(silhouettes.edgeCount())};

    // The normals of the silhouette's vertices.
    gl::Pass(clearNormals_)
        .bind("Silhouettes", silhouettes.edges())
        .bind("Commands", silhouettes.commands())
        .bind("VertexNormals", vertexNormals_)
        .dispatchIndirect(silhouettes.commands(), SilhouetteExtractor::dispatchOffset);
    gl::Pass(addNormals_)
        .constants(construction)
        .bind("Silhouettes", silhouettes.edges())
        .bind("Commands", silhouettes.commands())
        .bind("VertexNormals", vertexNormals_)
        .dispatchIndirect(silhouettes.commands(), SilhouetteExtractor::dispatchOffset);

    // How far away receivers are.
    constexpr std::size_t groups = tilesAcross / 8;
    gl::Pass(farthest_)
        .constants(construction)
        .bind(surfaces)
        .bind("SmoothieBlock", constants)
        .bind("Tiles", farthestTiles_)
        .dispatch(groups, groups, cameras);

    // The smoothies.
    gl::Pass(build_)
        .constants(construction)
        .bind("SmoothieBlock", constants)
        .bind("Tiles", farthestTiles_)
        .bind("Silhouettes", silhouettes.edges())
        .bind("Commands", silhouettes.commands())
        .bind("VertexNormals", vertexNormals_)
        .bind("SmoothieEdges", smoothieEdges_)
        .dispatchIndirect(silhouettes.commands(), SilhouetteExtractor::dispatchOffset);
}

}  // namespace penumbra::smoothies
