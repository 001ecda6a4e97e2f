// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/smoothies/smoothie_buffer.h"

#include <algorithm>
#include <array>
#include <limits>

#include "src/techniques/smoothies/smoothie_edges_io.h"

namespace penumbra::smoothies {

SmoothieBuffer::SmoothieBuffer(Device& device)
    : deepestEdge_(internalsOf(device).shaders, {"src/techniques/smoothies/smoothie.vert.glsl",
                                                 "src/techniques/smoothies/smoothie.geom.glsl",
                                                 "src/techniques/smoothies/smoothie.frag.glsl"}),
      leastAlpha_(
          internalsOf(device).shaders,
          {"src/techniques/smoothies/smoothie.vert.glsl", "src/techniques/smoothies/smoothie.geom.glsl",
           "src/techniques/smoothies/smoothie_alpha.frag.glsl"},
          {"STORED_ALPHA"}) {}

void SmoothieBuffer::draw(Keeps keeps, const SilhouetteExtractor& silhouettes, const gl::Buffer& edges,
                          const SurfaceMaps& surfaces, const gl::Buffer& constants) {
    keeps_ = keeps;
    cameras_ = surfaces.casters.count();
    const int mapSize_px = surfaces.casters.texture().width_px();
    if (keeps == Keeps::alpha) {
        stored_.fit({.width_px = mapSize_px,
                     .height_px = mapSize_px,
                     .layers = cameras_,
                     .format = gl::Format::rg32f,
                     .label = "smoothies/alpha and depth"});
        storedTarget_.fit({&stored_}, nullptr, "smoothies, stored");
        constexpr std::array<float, 4> nothing = {1, std::numeric_limits<float>::max(), 0, 0};
        gl::Pass pass(leastAlpha_);
        pass.into(storedTarget_,
                  {.width_px = mapSize_px, .height_px = mapSize_px, .blend = gl::Blend::smallest})
            .clearColor(0, nothing);
        drawInto(pass, silhouettes, edges, surfaces, constants);
        return;
    }
    gl::TextureSpec spec{.width_px = std::max(1, mapSize_px / smoothieTexel_px),
                         .layers = layersPerCamera * cameras_,
                         .format = gl::Format::r32ui,
                         .label = "smoothies/deepest edges"};
    spec.height_px = spec.width_px;
    deepest_.fit(spec);
    spec.format = gl::Format::depth32f;
    spec.label = "smoothies/order";
    order_.fit(spec);
    deepestTarget_.fit({&deepest_}, &order_, "smoothies");

    constexpr std::array<std::uint32_t, 4> noEdge = {0xffffffffu};
    gl::Pass pass(deepestEdge_);
    pass.into(deepestTarget_, {.width_px = spec.width_px,
                               .height_px = spec.height_px,
                               .depthTest = gl::Compare::less,
                               .depthWrite = true})
        .clearColor(0, noEdge)
        .clearDepth(1);
    drawInto(pass, silhouettes, edges, surfaces, constants);
}

void SmoothieBuffer::drawInto(gl::Pass& pass, const SilhouetteExtractor& silhouettes, const gl::Buffer& edges,
                              const SurfaceMaps& surfaces, const gl::Buffer& constants) const {
    pass.bind(surfaces);
    for (int camera = 0; camera < cameras_; ++camera) {
        const std::size_t first = std::size_t(camera) * silhouettes.edgeCount();
        std::size_t offset_bytes = first * sizeof(SmoothieEdge);
        for (const char* input : {"ends", "normals", "nearnessAndWidths"}) {
            pass.vertices(input, edges, {.offset_bytes = offset_bytes, .stride_bytes = sizeof(SmoothieEdge)});
            offset_bytes += sizeof(glm::vec4);
        }
        pass.constants(ConstructionConstants{.hasReceiverMaps = surfaces.hasReceivers, .drawnCamera = camera})
            .bind("SmoothieBlock", constants, std::size_t(camera) * sizeof(SmoothieConstants),
                  maxSmoothieCameras * sizeof(SmoothieConstants))
            .drawIndirect(gl::Primitive::points, silhouettes.commands());
    }
}

void SmoothieBuffer::inspect(InspectionVisitor& visitor) const {
    if (keeps_ == Keeps::alpha) {
        visitor.texture({.name = "smoothie buffer: alpha, and the depth of the nearest smoothie",
                         .texture = stored_.name(),
                         .layers = cameras_});
        return;
    }
    // a / (1 + a) of alpha: half at the penumbra's border. Outer half, then the inner one in three layers.
    visitor.texture({.name = "alpha of the deepest smoothies, outer and inner halves",
                     .texture = order_.name(),
                     .layers = layersPerCamera * cameras_,
                     .white = 0.5f});
}

}  // namespace penumbra::smoothies
