// SPDX-License-Identifier: Apache-2.0
// What the library keeps for a device; hosts see penumbra::Device alone.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "penumbra/device.h"
#include "src/gl/debug_log.h"
#include "src/gl/program.h"
#include "src/gl/shader_library.h"

namespace penumbra {

/// What devices have in common whose contexts share objects.
struct ShareGroup {
    std::uint64_t meshesMade = 0;
};

/// Shared by the device and by all that was made on it, so that none of it outlives what it needs.
struct Device::Internals : std::enable_shared_from_this<Device::Internals> {
    explicit Internals(DeviceOptions options);

    /// Throws Error::Kind::lostContext where the device was moved from.
    static Internals& of(const Device& device) { return device.internals(); }

    /// Throws Error::Kind::lostContext where the device was given up or is gone, and noOpenGL where another
    /// context than its own is current, or none.
    void requireContext() const;

    /// Another Device, for what must not depend on where the host's is. Using nothing up, and owning nothing.
    static Device handle(Internals& device) { return Device(device.shared_from_this()); }

    /// The host's Device is destroyed.
    void outliveDevice();

    std::shared_ptr<gl::ObjectRegistry> registry = std::make_shared<gl::ObjectRegistry>();
    gl::DebugLog log;
    gl::ShaderLibrary shaders;
    std::string renderer;
    std::string openGLVersion;
    int maxTextureSize_px = 0;
    std::size_t largestStorageBlock_bytes = 0;
    int maxLayers = 0;
    bool isSoftware = false;
    /// The vertex shader may write gl_Layer (ARB_shader_viewport_layer_array), so that one instanced draw
    /// serves many layers; else each layer is drawn by itself.
    bool layerFromVertexShader = false;
    bool isCompatibilityContext = false;
    bool keepHostState = true;
    bool diagnoses = false;
    bool hasWarnedOfPolygonOffset = false;
    bool isDeviceGone = false;
    std::shared_ptr<ShareGroup> shareGroup;
    std::optional<gl::Program> gatherVertices;  ///< see geometry/host_buffers.cpp; made when first needed
};

inline Device::Internals& internalsOf(const Device& device) {
    return Device::Internals::of(device);
}

}  // namespace penumbra
