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

struct Device::Internals {
    explicit Internals(DeviceOptions options);

    /// Throws Error::Kind::lostContext where the device was given up.
    void requireContext() const;

    std::shared_ptr<gl::Ledger> ledger = std::make_shared<gl::Ledger>();
    gl::DebugLog log;
    gl::ShaderLibrary shaders;
    std::string renderer;
    std::string version;
    int maxTextureSize_px = 0;
    std::size_t largestStorageBlock_bytes = 0;
    int maxLayers = 0;
    bool isSoftware = false;
    /// The vertex shader may write gl_Layer (ARB_shader_viewport_layer_array), so that one instanced draw
    /// serves many layers; else each layer is drawn by itself.
    bool layerFromVertexShader = false;
    bool keepHostState = true;
    std::uint64_t meshesMade = 0;
    std::optional<gl::Program> gatherVertices;  ///< see geometry/host_buffers.cpp; made when first needed
};

}  // namespace penumbra
