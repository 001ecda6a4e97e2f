// SPDX-License-Identifier: Apache-2.0
#include "src/gl/raster_state.h"

namespace penumbra::gl {
namespace {

void enable(GLenum capability, bool on) {
    on ? glEnable(capability) : glDisable(capability);
}

}  // namespace

void beginPass(GLuint framebuffer, const RasterState& state) {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, state.width_px, state.height_px);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glDepthRange(0, 1);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glFrontFace(GL_CCW);

    enable(GL_DEPTH_TEST, state.depthTest != GL_ALWAYS || state.depthWrite);
    glDepthFunc(state.depthTest);
    glDepthMask(state.depthWrite);
    enable(GL_DEPTH_CLAMP, state.depthClamp);
    enable(GL_CULL_FACE, state.cull != GL_NONE);
    if (state.cull != GL_NONE) glCullFace(state.cull);
    glColorMask(state.colorWrite, state.colorWrite, state.colorWrite, state.colorWrite);
    enable(GL_BLEND, state.blendEquation != GL_NONE);
    if (state.blendEquation != GL_NONE) {
        glBlendEquation(state.blendEquation);
        glBlendFunc(state.blendSource, state.blendDestination);
    }

    glDisable(GL_SCISSOR_TEST);
    for (const GLenum unused : unusedCapabilities) glDisable(unused);
}

}  // namespace penumbra::gl
