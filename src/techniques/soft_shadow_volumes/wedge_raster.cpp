// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/soft_shadow_volumes/wedge_raster.h"

#include <array>
#include <cstddef>

#include "src/geometry/edge_mesh.h"
#include "src/gl/raster_state.h"

namespace penumbra {
namespace {

constexpr const char* wedgeVertices = "src/techniques/soft_shadow_volumes/wedge.vert.glsl";
constexpr int verticesPerWedge = 24;
constexpr GLint halfLocation = 0, eyeLocation = 1;

gl::Texture makeTexture(glm::ivec2 size_px, gl::Format format, std::string_view label) {
    return gl::Texture({.width_px = size_px.x, .height_px = size_px.y, .format = format, .label = label});
}

bool isOfSize(const gl::Texture& texture, glm::ivec2 size_px) {
    return texture.name() != 0 && texture.width_px() == size_px.x && texture.height_px() == size_px.y;
}

}  // namespace

WedgeRaster::WedgeRaster(Device& device)
    : wedges_(device.internals().shaders,
              {wedgeVertices, "src/techniques/soft_shadow_volumes/wedge.frag.glsl"}),
      marks_(device.internals().shaders,
             {wedgeVertices, "src/techniques/soft_shadow_volumes/wedge_mark.frag.glsl"}),
      resolve_(device.internals().shaders, {"src/techniques/soft_shadow_volumes/wedge_resolve.comp.glsl"}),
      noVertices_(gl::makeFloatVertexArray()),
      points_(device) {}

void WedgeRaster::countAsBlockers(VolumeFrame& frame) {
    for (std::size_t i = 0; i < frame.sources.size(); ++i) {
        const EdgeMesh& edges = edgesOf(*frame.sources[i].mesh);
        const bool isClosed = edges.faces().size_bytes() == 2 * edges.edgeCount() * sizeof(uint);
        frame.layersEach[i] = isClosed ? 1 : 2;
    }
}

void WedgeRaster::allocate(glm::ivec2 size_px, bool isTextured, Options options) {
    if (!isOfSize(layers_, size_px) || isTextured != (colors_.name() != 0)) {
        layers_ = {};
        evaluations_ = {};
        colors_ = {};
        depthAndMarks_ = {};
        layers_ = makeTexture(size_px, gl::Format::rg32f, "soft-volumes/V-buffer layers");
        evaluations_ = makeTexture(size_px, gl::Format::r32f, "soft-volumes/wedges a pixel");
        depthAndMarks_ = makeTexture(size_px, gl::Format::depth32fStencil8, "soft-volumes/marks");
        if (isTextured) {
            colors_ = makeTexture(size_px, gl::Format::rgba32f, "soft-volumes/V-buffer colours");
            framebuffer_ = gl::Framebuffer({&layers_, &evaluations_, &colors_}, &depthAndMarks_,
                                           "soft-volumes/V-buffer layers");
        } else {
            framebuffer_ =
                gl::Framebuffer({&layers_, &evaluations_}, &depthAndMarks_, "soft-volumes/V-buffer layers");
        }
    }
    if (!options.wireframe) {
        wireframe_ = {};
    } else if (!isOfSize(wireframe_, size_px)) {
        wireframe_ = makeTexture(size_px, gl::Format::r32f, "soft-volumes/wireframe");
        wireframeFramebuffer_ = gl::Framebuffer({&wireframe_}, nullptr, "soft-volumes/wireframe");
    }
}

void WedgeRaster::drawAll(const VolumeCounter& counter) const {
    // Back faces alone, so that each wedge is evaluated once a pixel: also where the eye is inside of it.
    gl::beginPass(framebuffer_.name(), {.width_px = layers_.width_px(),
                                        .height_px = layers_.height_px(),
                                        .depthClamp = true,
                                        .cull = gl::Cull::front,
                                        .blend = gl::Blend::sum});
    wedges_.use();
    glUniform1i(halfLocation, 0);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, counter.eye().name());
    // NOLINTNEXTLINE(performance-no-int-to-ptr): an offset, as OpenGL has it
    glDrawArraysIndirect(GL_TRIANGLES, reinterpret_cast<const void*>(offsetof(EyeState, wedges)));
}

void WedgeRaster::markHalf(int wedge, int half, Counting counting) const {
    marks_.use();
    glUniform1i(halfLocation, half);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glStencilFunc(GL_ALWAYS, 0, 0xff);
    const bool automatic = counting == Counting::automatic;
    // Figure 10: what of the half wedge is before the receiver.
    if (counting != Counting::zFail) {
        glUniform1i(eyeLocation, automatic ? -1 : 0);
        glStencilOpSeparate(GL_FRONT, GL_KEEP, GL_KEEP, GL_INCR_WRAP);
        glStencilOpSeparate(GL_BACK, GL_KEEP, GL_KEEP, GL_DECR_WRAP);
        glDrawArrays(GL_TRIANGLES, verticesPerWedge * wedge, verticesPerWedge);
    }
    // Figure 11: what is behind, which is right wherever the eye is.
    if (counting != Counting::zPass) {
        glUniform1i(eyeLocation, automatic ? 1 : 0);
        glStencilOpSeparate(GL_FRONT, GL_KEEP, GL_DECR_WRAP, GL_KEEP);
        glStencilOpSeparate(GL_BACK, GL_KEEP, GL_INCR_WRAP, GL_KEEP);
        glDrawArrays(GL_TRIANGLES, verticesPerWedge * wedge, verticesPerWedge);
    }
    glUniform1i(eyeLocation, 0);
}

void WedgeRaster::addHalf(int wedge, int half) const {
    wedges_.use();
    glUniform1i(halfLocation, half);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT);
    glStencilFunc(GL_NOTEQUAL, 0, 0xff);
    glStencilOp(GL_KEEP, GL_KEEP, GL_ZERO);
    glDrawArrays(GL_TRIANGLES, verticesPerWedge * wedge, verticesPerWedge);
}

void WedgeRaster::drawMarked(const VolumeFrame& frame, const VolumeCounter& counter,
                             Counting counting) const {
    // Nothing is read back: each edge is drawn that may be a silhouette, and those that are none have no
    // triangles.
    const glm::ivec4 buffer_px = frame.constants.buffer_px;
    counter.drawReceiverDepth(framebuffer_.name(), glm::ivec2(buffer_px));
    gl::beginPass(framebuffer_.name(),
                  {.width_px = buffer_px.x,
                   .height_px = buffer_px.y,
                   .depthTest = buffer_px.w == 1 ? gl::Compare::greater : gl::Compare::less,
                   .depthClamp = true,
                   .blend = gl::Blend::sum});
    glEnable(GL_STENCIL_TEST);
    for (int wedge = 0; wedge < int(counter.silhouettes().edgeCount()); ++wedge) {
        for (const int half : {1, -1}) {
            markHalf(wedge, half, counting);
            addHalf(wedge, half);
        }
    }
}

void WedgeRaster::drawWireframe(const VolumeCounter& counter, glm::ivec2 size_px) const {
    gl::beginPass(wireframeFramebuffer_.name(),
                  {.width_px = size_px.x, .height_px = size_px.y, .depthClamp = true});
    const std::array<float, 4> zero{};
    glClearNamedFramebufferfv(wireframeFramebuffer_.name(), GL_COLOR, 0, zero.data());
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    marks_.use();
    glUniform1i(halfLocation, 0);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, counter.eye().name());
    // NOLINTNEXTLINE(performance-no-int-to-ptr)
    glDrawArraysIndirect(GL_TRIANGLES, reinterpret_cast<const void*>(offsetof(EyeState, wedges)));
}

void WedgeRaster::render(const VolumeFrame& frame, const AreaLight& light, const VolumeCounter& counter,
                         Options options, GLuint target, gl::Format format, gl::PassTimers& timers) {
    const glm::ivec2 size_px(frame.constants.buffer_px);
    const bool isTextured = light.radianceTexture != 0;
    allocate(size_px, isTextured, options);
    if (isTextured) points_.place(light, LightPoints::most / 2);
    glBindVertexArray(noVertices_.name());
    counter.silhouettes().bindEdges(0);
    counter.bindLayersEach(1);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, counter.silhouettes().commands().name());
    counter.depth().bind(4);
    {
        const auto pass = timers.pass("soft-volumes/wedges");
        gl::beginPass(framebuffer_.name(), {.width_px = size_px.x, .height_px = size_px.y});
        const std::array<float, 4> zero{};
        for (int i = 0; i < (isTextured ? 3 : 2); ++i)
            glClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, i, zero.data());
        wedges_.use();
        points_.bindTable(5);
        if (options.marking == Marking::stencil) {
            const GLint unmarked = 0;
            glStencilMask(0xff);
            glClearNamedFramebufferiv(framebuffer_.name(), GL_STENCIL, 0, &unmarked);
            drawMarked(frame, counter, options.counting);
        } else {
            drawAll(counter);
        }
    }
    if (options.wireframe) {
        const auto pass = timers.pass("soft-volumes/wireframe");
        drawWireframe(counter, size_px);
    }
    const auto pass = timers.pass("soft-volumes/visibility");
    resolve_.use();
    counter.bind(3, 2);
    layers_.bind(5);
    if (isTextured) colors_.bind(6);
    glBindImageTexture(0, target, 0, GL_FALSE, 0, GL_WRITE_ONLY, GLenum(format));
    gl::dispatchPixels(size_px.x, size_px.y);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

void WedgeRaster::inspect(InspectionVisitor& visitor) const {
    if (layers_.name() == 0) return;
    visitor.texture({.name = "additive and subtractive layers", .texture = layers_.name()});
    if (colors_.name() != 0) visitor.texture({.name = "layers of each channel", .texture = colors_.name()});
    visitor.texture({.name = "wedges a pixel", .texture = evaluations_.name(), .white = 16});
    if (wireframe_.name() != 0)
        visitor.texture({.name = "wedges as wireframe", .texture = wireframe_.name()});
}

}  // namespace penumbra
