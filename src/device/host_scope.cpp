// SPDX-License-Identifier: Apache-2.0
#include "src/device/host_scope.h"

#include <sstream>

namespace penumbra {
namespace {

void require(bool condition, const char* message) {
    if (!condition) throw Error(Error::Kind::badArgument, message);
}

/// Errors that the host has left behind would be taken for ours: they are taken away, and told.
void reportPendingErrors(const gl::DebugLog& log) {
    // A lost context may answer with errors for ever.
    constexpr int most = 16;
    for (int i = 0; i < most; ++i) {
        const GLenum error = glGetError();
        if (error == GL_NO_ERROR) return;
        std::ostringstream message;
        message << "an OpenGL error was pending before this call, which is not Penumbra's: 0x" << std::hex
                << error;
        log.write(LogLevel::warning, message.str());
    }
}

/// What was destroyed while the context was not current.
void deleteOrphans(gl::ObjectRegistry& registry) {
    for (const auto& [destroy, name] : std::exchange(registry.orphans, {})) destroy(name);
}

void requireNoTransformFeedback() {
    GLboolean active = GL_FALSE, paused = GL_FALSE;
    glGetBooleanv(GL_TRANSFORM_FEEDBACK_ACTIVE, &active);
    glGetBooleanv(GL_TRANSFORM_FEEDBACK_PAUSED, &paused);
    require(active == GL_FALSE || paused == GL_TRUE,
            "transform feedback is active: end or pause it before this call");
}

/// What compatibility contexts can be in the midst of, in which nothing may be drawn or asked for.
void requireImmediateRendering() {
    constexpr GLint unanswered = -1;
    GLint list = unanswered, mode = GL_RENDER;
    glGetIntegerv(GL_LIST_INDEX, &list);
    require(list != unanswered, "this call stands between glBegin and glEnd: call glEnd before it");
    require(list == 0, "a display list is being compiled: call glEndList before this call");
    glGetIntegerv(GL_RENDER_MODE, &mode);
    require(mode == GL_RENDER,
            "the context is in select or feedback mode: call glRenderMode(GL_RENDER) before this call");
}

}  // namespace

HostScope::HostScope(const Device::Internals& device) : registry_(device.registry) {
    device.requireContext();
    reportPendingErrors(device.log);
    if (device.isCompatibilityContext) requireImmediateRendering();
    requireNoTransformFeedback();
    deleteOrphans(*device.registry);
    if (glIsEnabled(GL_POLYGON_OFFSET_FILL)) {
        glGetFloatv(GL_POLYGON_OFFSET_FACTOR, &polygonOffset_.factor);
        glGetFloatv(GL_POLYGON_OFFSET_UNITS, &polygonOffset_.units);
    }
    if (device.keepHostState) state_.emplace();
    setKnownState();
}

}  // namespace penumbra
