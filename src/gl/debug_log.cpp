// SPDX-License-Identifier: Apache-2.0
#include "src/gl/debug_log.h"

#include "src/gl/gl.h"

namespace penumbra::gl {
namespace {

void onMessage(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length, const GLchar* text,
               const void* user) {
    static_cast<DebugLog*>(const_cast<void*>(user))->receive(type, severity, {text, std::size_t(length)});
}

}  // namespace

DebugLog::DebugLog(std::function<void(LogLevel, std::string_view)> log) : log_(std::move(log)) {
    void* present = nullptr;
    glGetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &present);
    if (present != nullptr) return;
    glDebugMessageCallback(onMessage, this);
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DEBUG_SEVERITY_NOTIFICATION, 0, nullptr, GL_FALSE);
    installed_ = true;
}

DebugLog::~DebugLog() {
    if (installed_) glDebugMessageCallback(nullptr, nullptr);
}

void DebugLog::receive(unsigned type, unsigned severity, std::string_view message) {
    const bool severe = severity == GL_DEBUG_SEVERITY_HIGH || type == GL_DEBUG_TYPE_ERROR ||
                        type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR;
    if (severe) ++severeMessages_;
    write(severe ? LogLevel::error : LogLevel::debug, message);
}

}  // namespace penumbra::gl
