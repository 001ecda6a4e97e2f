// SPDX-License-Identifier: Apache-2.0
#include "src/gl/debug_log.h"

namespace penumbra::gl {

DebugLog::DebugLog(std::function<void(LogLevel, std::string_view)> log,
                   std::shared_ptr<const ObjectRegistry> registry)
    : registry_(std::move(registry)) {
    sink_->log = std::move(log);
    void* present = nullptr;
    glGetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &present);
    if (present != nullptr) return;
    glDebugMessageCallback(
        [](GLenum, GLenum type, GLuint, GLenum severity, GLsizei length, const GLchar* text,
           const void* sink) {
            static_cast<Sink*>(const_cast<void*>(sink))->receive(type, severity, {text, std::size_t(length)});
        },
        sink_.get());
    installed_ = true;
}

DebugLog::~DebugLog() {
    close();
}

void DebugLog::close() {
    sink_->log = nullptr;
    if (!std::exchange(installed_, false) || registry_->contextLost) return;
    if (!registry_->isReachable()) {
        sink_->itself = sink_;
        return;
    }
    void* present = nullptr;
    glGetPointerv(GL_DEBUG_CALLBACK_USER_PARAM, &present);
    if (present == sink_.get()) glDebugMessageCallback(nullptr, nullptr);
}

void DebugLog::Sink::receive(unsigned type, unsigned severity, std::string_view message) {
    // Filtered here and not in the driver, whose filter a host could not get back.
    if (severity == GL_DEBUG_SEVERITY_NOTIFICATION) return;
    const bool severe = severity == GL_DEBUG_SEVERITY_HIGH || type == GL_DEBUG_TYPE_ERROR ||
                        type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR;
    if (severe) ++severeMessages;
    write(severe ? LogLevel::error : LogLevel::debug, message);
}

}  // namespace penumbra::gl
