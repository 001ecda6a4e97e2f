// SPDX-License-Identifier: Apache-2.0
#include "src/gl/debug_log.h"

namespace penumbra::gl {
namespace {

void onMessage(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length, const GLchar* text,
               const void* user) {
    static_cast<DebugLog*>(const_cast<void*>(user))->receive(type, severity, {text, std::size_t(length)});
}

}  // namespace

DebugLog::DebugLog(std::function<void(LogLevel, std::string_view)> log, std::shared_ptr<const Ledger> ledger)
    : log_(std::move(log)), ledger_(std::move(ledger)) {
    void* present = nullptr;
    glGetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &present);
    if (present != nullptr) return;
    glDebugMessageCallback(onMessage, this);
    installed_ = true;
}

DebugLog::~DebugLog() {
    if (!installed_ || ledger_->contextLost) return;
    void* present = nullptr;
    glGetPointerv(GL_DEBUG_CALLBACK_USER_PARAM, &present);
    if (present == this) glDebugMessageCallback(nullptr, nullptr);
}

void DebugLog::receive(unsigned type, unsigned severity, std::string_view message) {
    // Filtered here and not in the driver, whose filter a host could not get back.
    if (severity == GL_DEBUG_SEVERITY_NOTIFICATION) return;
    const bool severe = severity == GL_DEBUG_SEVERITY_HIGH || type == GL_DEBUG_TYPE_ERROR ||
                        type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR;
    if (severe) ++severeMessages_;
    write(severe ? LogLevel::error : LogLevel::debug, message);
}

}  // namespace penumbra::gl
