// SPDX-License-Identifier: Apache-2.0
#include "studio/context/headless_context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace penumbra::studio {
namespace {

/// A display that EGL offers and how to name it.
struct Candidate {
    EGLDisplay display = EGL_NO_DISPLAY;
    std::string name;
    bool software = false;
};

bool contains(const char* list, std::string_view word) {
    return list != nullptr && std::string_view(list).find(word) != std::string_view::npos;
}

std::vector<Candidate> candidates() {
    std::vector<Candidate> found;
    const char* const client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (contains(client, "EGL_EXT_platform_device") && contains(client, "EGL_EXT_device_enumeration")) {
        std::array<EGLDeviceEXT, 32> devices{};
        EGLint count = 0;
        eglQueryDevicesEXT(EGLint(devices.size()), devices.data(), &count);
        for (EGLint i = 0; i < count; ++i) {
            const EGLDeviceEXT device = devices[std::size_t(i)];
            const char* const extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
            const char* file = contains(extensions, "EGL_EXT_device_drm")
                                   ? eglQueryDeviceStringEXT(device, EGL_DRM_DEVICE_FILE_EXT)
                                   : nullptr;
            const bool software = contains(extensions, "EGL_MESA_device_software");
            found.push_back({eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr),
                             software          ? "EGL software device"
                             : file != nullptr ? std::string("EGL device ") + file
                                               : "EGL device",
                             software});
        }
        std::ranges::stable_sort(found, {}, &Candidate::software);
    }
    if (contains(client, "EGL_MESA_platform_surfaceless")) {
        found.push_back(
            {eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr),
             "Mesa surfaceless", true});
    }
    return found;
}

/// Makes a context on `display` and makes it current; on failure leaves `whyNot`.
EGLContext makeContext(EGLDisplay display, ContextProfile profile, EGLContext shared, std::string& whyNot) {
    EGLint major = 0, minor = 0;
    if (display == EGL_NO_DISPLAY || eglInitialize(display, &major, &minor) == EGL_FALSE) {
        whyNot = "EGL cannot initialise it";
        return EGL_NO_CONTEXT;
    }
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) {
        whyNot = "its driver has no desktop OpenGL";
        return EGL_NO_CONTEXT;
    }
    constexpr std::array<EGLint, 5> anyConfig = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                                 EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    eglChooseConfig(display, anyConfig.data(), &config, 1, &count);
    const bool isCore = profile == ContextProfile::core;
    const std::array<EGLint, 13> attributes = {
        EGL_CONTEXT_MAJOR_VERSION,
        4,
        EGL_CONTEXT_MINOR_VERSION,
        5,
        EGL_CONTEXT_OPENGL_PROFILE_MASK,
        isCore ? EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT : EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT,
        EGL_CONTEXT_OPENGL_DEBUG,
        EGL_TRUE,
        EGL_CONTEXT_OPENGL_ROBUST_ACCESS,
        EGL_TRUE,
        EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
        EGL_LOSE_CONTEXT_ON_RESET,
        EGL_NONE};
    const EGLContext context =
        eglCreateContext(display, count > 0 ? config : EGL_NO_CONFIG_KHR, shared, attributes.data());
    if (context == EGL_NO_CONTEXT) {
        whyNot = isCore ? "its driver has no OpenGL 4.5 core context"
                        : "its driver has no OpenGL 4.5 compatibility context";
        return EGL_NO_CONTEXT;
    }
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE) {
        whyNot = "its context cannot be used without a window";
        eglDestroyContext(display, context);
        return EGL_NO_CONTEXT;
    }
    return context;
}

void destroyContext(EGLDisplay display, EGLContext context) {
    if (eglGetCurrentContext() == context) {
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    eglDestroyContext(display, context);
}

}  // namespace

struct HeadlessContext::State {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    ~State() {
        if (context != EGL_NO_CONTEXT) destroyContext(display, context);
    }
};

std::vector<HeadlessDevice> listHeadlessDevices() {
    std::vector<HeadlessDevice> devices;
    for (const Candidate& candidate : candidates()) {
        HeadlessDevice& device = devices.emplace_back();
        device.name = candidate.name;
        const EGLContext context =
            makeContext(candidate.display, ContextProfile::core, EGL_NO_CONTEXT, device.whyNot);
        if (context == EGL_NO_CONTEXT) continue;
        device.usable = true;
        device.name += std::string(": ") + reinterpret_cast<const char*>(glGetString(GL_RENDERER));
        destroyContext(candidate.display, context);
    }
    return devices;
}

HeadlessContext::HeadlessContext(std::optional<int> device, ContextProfile profile,
                                 const HeadlessContext* shared)
    : state_(std::make_unique<State>()) {
    const std::vector<Candidate> found = candidates();
    std::string tried;
    for (int i = 0; i < int(found.size()); ++i) {
        if (device && i != *device) continue;
        const Candidate& candidate = found[std::size_t(i)];
        std::string whyNot;
        if (shared != nullptr && shared->state_->display != candidate.display) continue;
        state_->context = makeContext(candidate.display, profile,
                                      shared != nullptr ? shared->state_->context : EGL_NO_CONTEXT, whyNot);
        state_->display = candidate.display;
        if (state_->context != EGL_NO_CONTEXT) return;
        tried += "\n  device " + std::to_string(i) + " (" + candidate.name + "): " + whyNot;
    }
    if (device && tried.empty()) {
        throw NoOpenGLError("there is no device " + std::to_string(*device) + ": EGL offers " +
                            std::to_string(found.size()) + " (see 'penumbra list devices')");
    }
    throw NoOpenGLError("no usable OpenGL 4.5" + (tried.empty() ? ": EGL offers no device" : ":" + tried) +
                        "\nInstall a driver; the software renderer of the package libgl1-mesa-dri will do.");
}

HeadlessContext::HeadlessContext(HeadlessContext&&) noexcept = default;
HeadlessContext& HeadlessContext::operator=(HeadlessContext&&) noexcept = default;
HeadlessContext::~HeadlessContext() = default;

void HeadlessContext::makeCurrent() const {
    eglMakeCurrent(state_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, state_->context);
}

void HeadlessContext::makeNoneCurrent() const {
    eglMakeCurrent(state_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

}  // namespace penumbra::studio
