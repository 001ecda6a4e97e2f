// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/smoothies/smoothie_buffer.h"

#include <algorithm>
#include <array>

#include "src/techniques/smoothies/smoothie_edges_io.h"

namespace penumbra {

SmoothieBuffer::SmoothieBuffer(Device& device)
    : smoothie_(device.internals().shaders,
                {"src/techniques/smoothies/smoothie.vert.glsl", "src/techniques/smoothies/smoothie.geom.glsl",
                 "src/techniques/smoothies/smoothie.frag.glsl"}) {}

void SmoothieBuffer::draw(const SilhouetteExtractor& silhouettes, const gl::Buffer& edges,
                          const SurfaceMaps& surfaces, const gl::Buffer& constants) {
    const int cameras = surfaces.casters.count();
    layers_ = layersPerCamera * cameras;
    gl::TextureSpec spec{.width_px = std::max(1, surfaces.casters.texture().width_px() / smoothieTexel_px),
                         .layers = layers_,
                         .format = gl::Format::r32ui,
                         .label = "smoothies/deepest edges"};
    spec.height_px = spec.width_px;
    const bool isNew = deepest_.fit(spec);
    spec.format = gl::Format::depth32f;
    spec.label = "smoothies/order";
    order_.fit(spec);
    if (isNew) framebuffer_ = gl::Framebuffer({&deepest_}, &order_, "smoothies");

    constexpr std::array<std::uint32_t, 4> noEdge = {0xffffffffu};
    gl::Pass pass(smoothie_);
    pass.bind(surfaces)
        .into(framebuffer_, {.width_px = spec.width_px,
                             .height_px = spec.height_px,
                             .depthTest = gl::Compare::less,
                             .depthWrite = true})
        .clearColor(0, noEdge)
        .clearDepth(1);
    for (int camera = 0; camera < cameras; ++camera) {
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
    // a / (1 + a) of alpha: half at the penumbra's border. Outer half, then the inner one in three layers.
    visitor.texture({.name = "alpha of the deepest smoothies, outer and inner halves",
                     .texture = order_.name(),
                     .layers = layers_,
                     .white = 0.5f});
}

}  // namespace penumbra
