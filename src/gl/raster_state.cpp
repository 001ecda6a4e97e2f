// SPDX-License-Identifier: Apache-2.0
#include "src/gl/raster_state.h"

namespace penumbra::gl {
namespace {

void enable(GLenum capability, bool on) {
    on ? glEnable(capability) : glDisable(capability);
}

void setDepth(const RasterState& state) {
    enable(GL_DEPTH_TEST, state.depthTest != Compare::always || state.depthWrite);
    glDepthFunc(GLenum(state.depthTest));
    glDepthMask(state.depthWrite);
}

void setCull(Cull cull) {
    enable(GL_CULL_FACE, cull != Cull::none);
    if (cull != Cull::none) glCullFace(GLenum(cull));
}

void setBlend(Blend blend) {
    enable(GL_BLEND, blend != Blend::none);
    if (blend == Blend::none) return;
    const bool multiplies = blend == Blend::product;
    glBlendEquation(multiplies ? GL_FUNC_ADD : GLenum(blend));
    glBlendFunc(multiplies ? GL_ZERO : GL_ONE, multiplies ? GL_SRC_COLOR : GL_ONE);
}

void setStencil(const std::optional<StencilState>& stencil) {
    enable(GL_STENCIL_TEST, stencil.has_value());
    if (!stencil) return;
    glStencilMask(0xff);
    glStencilFunc(GLenum(stencil->compare), 0, 0xff);
    for (const auto& [side, face] : {std::pair{GL_FRONT, stencil->front}, std::pair{GL_BACK, stencil->back}})
        glStencilOpSeparate(GLenum(side), GL_KEEP, GLenum(face.depthFails), GLenum(face.passes));
}

}  // namespace

void beginPass(GLuint framebuffer, const RasterState& state) {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, state.width_px, state.height_px);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glDepthRange(0, 1);
    glPolygonMode(GL_FRONT_AND_BACK, state.wireframe ? GL_LINE : GL_FILL);
    glFrontFace(GL_CCW);
    glDisable(GL_SCISSOR_TEST);
    for (const GLenum unused : unusedCapabilities) glDisable(unused);

    setDepth(state);
    enable(GL_DEPTH_CLAMP, state.depthClamp);
    setCull(state.cull);
    glColorMask(state.colorWrite, state.colorWrite, state.colorWrite, state.colorWrite);
    setBlend(state.blend);
    setStencil(state.stencil);
}

void changePass(const RasterState& before, const RasterState& state) {
    if (before.depthTest != state.depthTest || before.depthWrite != state.depthWrite) setDepth(state);
    if (before.depthClamp != state.depthClamp) enable(GL_DEPTH_CLAMP, state.depthClamp);
    if (before.cull != state.cull) setCull(state.cull);
    if (before.colorWrite != state.colorWrite)
        glColorMask(state.colorWrite, state.colorWrite, state.colorWrite, state.colorWrite);
    if (before.blend != state.blend) setBlend(state.blend);
    if (before.stencil != state.stencil) setStencil(state.stencil);
    if (before.wireframe != state.wireframe)
        glPolygonMode(GL_FRONT_AND_BACK, state.wireframe ? GL_LINE : GL_FILL);
}

}  // namespace penumbra::gl
