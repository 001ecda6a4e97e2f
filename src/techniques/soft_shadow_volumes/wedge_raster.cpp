// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/soft_shadow_volumes/wedge_raster.h"

#include <array>
#include <cstddef>

#include "src/geometry/edge_mesh.h"
#include "src/gl/raster_state.h"

namespace penumbra {

WedgeRaster::WedgeRaster(Device& device)
    : wedges_(device.internals().shaders, {"src/techniques/soft_shadow_volumes/wedge.vert.glsl",
                                           "src/techniques/soft_shadow_volumes/wedge.frag.glsl"}),
      resolve_(device.internals().shaders, {"src/techniques/soft_shadow_volumes/wedge_resolve.comp.glsl"}),
      noVertices_(gl::makeFloatVertexArray()) {}

void WedgeRaster::countAsBlockers(VolumeFrame& frame) {
    for (std::size_t i = 0; i < frame.sources.size(); ++i) {
        const EdgeMesh& edges = edgesOf(*frame.sources[i].mesh);
        const bool isClosed = edges.faces().size_bytes() == 2 * edges.edgeCount() * sizeof(uint);
        frame.layersEach[i] = isClosed ? 1 : 2;
    }
}

void WedgeRaster::render(const VolumeFrame& frame, const VolumeCounter& counter, GLuint target, GLenum format,
                         gl::PassTimers& timers) {
    const glm::ivec2 size_px(frame.constants.buffer_px);
    if (layers_.name() == 0 || layers_.width_px() != size_px.x || layers_.height_px() != size_px.y) {
        layers_ = {};
        layers_ = gl::Texture({.width_px = size_px.x,
                               .height_px = size_px.y,
                               .format = GL_RG32F,
                               .label = "soft-volumes/V-buffer layers"});
        framebuffer_ = gl::Framebuffer({&layers_}, nullptr, "soft-volumes/V-buffer layers");
    }
    {
        const auto pass = timers.pass("soft-volumes/wedges");
        // Back faces alone, so that each wedge is evaluated once a pixel: also where the eye is inside of it.
        gl::beginPass(framebuffer_.name(), {.width_px = size_px.x,
                                            .height_px = size_px.y,
                                            .depthClamp = true,
                                            .cull = GL_FRONT,
                                            .blendEquation = GL_FUNC_ADD});
        const std::array<float, 4> zero{};
        glClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, 0, zero.data());
        wedges_.use();
        glBindVertexArray(noVertices_.name());
        counter.silhouettes().bindEdges(0);
        counter.bindLayersEach(1);
        counter.depth().bind(4);
        glBindBuffer(GL_DRAW_INDIRECT_BUFFER, counter.eye().name());
        // NOLINTNEXTLINE(performance-no-int-to-ptr): an offset, as OpenGL has it
        glDrawArraysIndirect(GL_TRIANGLES, reinterpret_cast<const void*>(offsetof(EyeState, wedges)));
    }
    const auto pass = timers.pass("soft-volumes/visibility");
    resolve_.use();
    counter.bind(3, 2);
    layers_.bind(5);
    glBindImageTexture(0, target, 0, GL_FALSE, 0, GL_WRITE_ONLY, format);
    gl::dispatchPixels(size_px.x, size_px.y);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

}  // namespace penumbra
