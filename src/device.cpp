// SPDX-License-Identifier: Apache-2.0
#include "penumbra/device.h"

#include <dlfcn.h>

#include <algorithm>
#include <utility>

#include "src/device_internals.h"
#include "src/gl/gl.h"
#include "src/hosting/host_scope.h"
#include "src/shaders.h"

namespace penumbra {
namespace {

/// libepoxy ends the process when OpenGL is called without a context, so the platform libraries that the host
/// has loaded are asked first; none of them is loaded for the question's sake.
bool hasCurrentContext() {
    using GetCurrentContext = void* (*)();
    for (const auto& [library, function] :
         {std::pair{"libEGL.so.1", "eglGetCurrentContext"}, std::pair{"libGL.so.1", "glXGetCurrentContext"},
          std::pair{"libGLX.so.0", "glXGetCurrentContext"}}) {
        void* const loaded = dlopen(library, RTLD_LAZY | RTLD_NOLOAD);
        if (loaded == nullptr) continue;
        const auto current = reinterpret_cast<GetCurrentContext>(dlsym(loaded, function));
        const bool found = current != nullptr && current() != nullptr;
        dlclose(loaded);
        if (found) return true;
    }
    return false;
}

/// Checked before anything else touches OpenGL.
void requireOpenGL45() {
    if (!hasCurrentContext()) {
        throw Error(Error::Kind::noOpenGL, "no OpenGL context is current on this thread");
    }
    const int version = epoxy_gl_version();
    if (!epoxy_is_desktop_gl() || version < 45) {
        throw Error(Error::Kind::noOpenGL, "Penumbra needs OpenGL 4.5; the current context has " +
                                               std::string(epoxy_is_desktop_gl() ? "OpenGL " : "OpenGL ES ") +
                                               std::to_string(version / 10) + "." +
                                               std::to_string(version % 10));
    }
}

int integer(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

std::string text(GLenum name) {
    return reinterpret_cast<const char*>(glGetString(name));
}

gl::DebugLog startLog(std::function<void(LogLevel, std::string_view)>&& log,
                      const std::shared_ptr<gl::Ledger>& ledger) {
    requireOpenGL45();
    return gl::DebugLog(std::move(log), ledger);
}

}  // namespace

Device::Internals::Internals(DeviceOptions options)
    : log(startLog(std::move(options.log), ledger)),
      shaders(std::move(options.shaderSourceDirectory)),
      renderer(text(GL_RENDERER)),
      version(text(GL_VERSION)),
      maxTextureSize_px(integer(GL_MAX_TEXTURE_SIZE)),
      largestStorageBlock_bytes(std::size_t(integer(GL_MAX_SHADER_STORAGE_BLOCK_SIZE))),
      maxLayers(std::min(integer(GL_MAX_ARRAY_TEXTURE_LAYERS), integer(GL_MAX_FRAMEBUFFER_LAYERS))),
      layerFromVertexShader(epoxy_has_gl_extension("GL_ARB_shader_viewport_layer_array")),
      keepHostState(options.keepHostState) {
    for (const char* name : {"llvmpipe", "softpipe", "SwiftShader"}) {
        isSoftware |= renderer.find(name) != std::string::npos;
    }
    shaders.add(libraryShaders());
}

void Device::Internals::requireContext() const {
    if (!ledger->contextLost) return;
    throw Error(Error::Kind::lostContext,
                "the device was abandoned: make a new Device, and new meshes and techniques on it");
}

Device::Device(DeviceOptions options) : internals_(std::make_unique<Internals>(std::move(options))) {}
Device::Device(Device&&) noexcept = default;
Device& Device::operator=(Device&&) noexcept = default;
Device::~Device() = default;

const std::string& Device::renderer() const {
    return internals_->renderer;
}
const std::string& Device::version() const {
    return internals_->version;
}
bool Device::isSoftware() const {
    return internals_->isSoftware;
}
int Device::maxTextureSize_px() const {
    return internals_->maxTextureSize_px;
}
int Device::severeMessageCount() const {
    return internals_->log.severeMessageCount();
}
std::size_t Device::memory_bytes() const {
    return internals_->ledger->size_bytes;
}
void Device::abandon() {
    internals_->ledger->contextLost = true;
}
void Device::reloadShaders() {
    const HostScope scope(*internals_);
    internals_->shaders.reload();
}

}  // namespace penumbra
