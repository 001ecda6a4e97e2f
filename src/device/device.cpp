// SPDX-License-Identifier: Apache-2.0
#include "penumbra/device.h"

#include <algorithm>
#include <utility>

#include "penumbra/version.h"
#include "src/device/device_internals.h"
#include "src/device/host_scope.h"
#include "src/gl/gl.h"
#include "src/shaders.h"

namespace penumbra {
namespace {

/// Checked before anything else touches OpenGL.
void requireOpenGL45() {
    if (!gl::ContextIdentity::ofCurrent().exists()) {
        throw Error(Error::Kind::noOpenGL,
                    "Device: no OpenGL context is current on this thread: make one current before");
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
                      const std::shared_ptr<gl::ObjectRegistry>& registry) {
    requireOpenGL45();
    registry->context = gl::ContextIdentity::ofCurrent();
    return gl::DebugLog(std::move(log), registry);
}

}  // namespace

Device::Internals::Internals(DeviceOptions options)
    : log(startLog(std::move(options.log), registry)),
      shaders(std::move(options.shaderSourceDirectory)),
      renderer(text(GL_RENDERER)),
      openGLVersion(text(GL_VERSION)),
      maxTextureSize_px(integer(GL_MAX_TEXTURE_SIZE)),
      largestStorageBlock_bytes(std::size_t(integer(GL_MAX_SHADER_STORAGE_BLOCK_SIZE))),
      maxLayers(std::min(integer(GL_MAX_ARRAY_TEXTURE_LAYERS), integer(GL_MAX_FRAMEBUFFER_LAYERS))),
      layerFromVertexShader(epoxy_has_gl_extension("GL_ARB_shader_viewport_layer_array")),
      isCompatibilityContext(penumbra::isCompatibilityContext()),
      keepHostState(options.keepHostState),
      diagnoses(options.diagnose),
      shareGroup(options.shared != nullptr ? internalsOf(*options.shared).shareGroup
                                           : std::make_shared<ShareGroup>()) {
    for (const char* name : {"llvmpipe", "softpipe", "SwiftShader"}) {
        isSoftware |= renderer.find(name) != std::string::npos;
    }
    shaders.add(libraryShaders());
}

#define PENUMBRA_TEXT_OF(number) #number
#define PENUMBRA_DOTTED(major, minor, patch) \
    PENUMBRA_TEXT_OF(major) "." PENUMBRA_TEXT_OF(minor) "." PENUMBRA_TEXT_OF(patch)

std::string_view version() {
    return PENUMBRA_DOTTED(PENUMBRA_VERSION_MAJOR, PENUMBRA_VERSION_MINOR, PENUMBRA_VERSION_PATCH);
}

void Device::Internals::requireContext() const {
    if (isDeviceGone) {
        throw Error(Error::Kind::lostContext,
                    "the Device is destroyed on which this was made: keep it for as long as its techniques, "
                    "meshes and visibility buffers are used");
    }
    if (registry->contextLost) {
        throw Error(Error::Kind::lostContext,
                    "the device was abandoned: make a new Device, and new meshes and techniques on it");
    }
    if (registry->context.isCurrent()) return;
    throw Error(Error::Kind::noOpenGL,
                gl::ContextIdentity::ofCurrent().exists()
                    ? "another OpenGL context is current than the device's: make the device's current "
                      "before this call, or make a Device for each context"
                    : "no OpenGL context is current on this thread: make the device's current before this "
                      "call");
}

void Device::Internals::outliveDevice() {
    isDeviceGone = true;
    if (!registry->isReachable() && !registry->contextLost) {
        log.write(LogLevel::warning,
                  "the Device is destroyed while its OpenGL context is not current: what it has there is "
                  "left to the context");
        registry->contextLost = true;
    }
    log.close();
}

Device::Device(DeviceOptions options) : internals_(std::make_shared<Internals>(std::move(options))) {}
Device::Device(std::shared_ptr<Internals> internals) : internals_(std::move(internals)), isTheHosts_(false) {}
Device::Device(Device&&) noexcept = default;
Device& Device::operator=(Device&& other) noexcept {
    if (this == &other) return *this;
    if (internals_ && isTheHosts_) internals_->outliveDevice();
    internals_ = std::move(other.internals_);
    isTheHosts_ = other.isTheHosts_;
    return *this;
}
Device::~Device() {
    if (internals_ && isTheHosts_) internals_->outliveDevice();
}

Device::Internals& Device::internals() const {
    if (internals_) return *internals_;
    throw Error(Error::Kind::lostContext, "Device: it was moved from: use the Device that it was moved to");
}

const std::string& Device::renderer() const {
    return internals().renderer;
}
const std::string& Device::openGLVersion() const {
    return internals().openGLVersion;
}
bool Device::isSoftware() const {
    return internals().isSoftware;
}
int Device::maxTextureSize_px() const {
    return internals().maxTextureSize_px;
}
int Device::severeMessageCount() const {
    return internals().log.severeMessageCount();
}
std::size_t Device::memory_bytes() const {
    return internals().registry->size_bytes;
}
void Device::abandon() {
    internals().registry->contextLost = true;
}
void Device::reloadShaders() {
    const HostScope scope(internals());
    internals().shaders.reload();
}

}  // namespace penumbra
