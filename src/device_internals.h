// SPDX-License-Identifier: Apache-2.0
// What the library keeps for a device; hosts see penumbra::Device alone.
#pragma once

#include <string>

#include "penumbra/device.h"
#include "src/gl/debug_log.h"
#include "src/gl/shader_library.h"

namespace penumbra {

struct Device::Internals {
    explicit Internals(DeviceOptions options);

    gl::DebugLog log;
    gl::ShaderLibrary shaders;
    std::string renderer;
    std::string version;
    int maxTextureSize_px = 0;
    int maxLayers = 0;
    bool isSoftware = false;
    /// The vertex shader may write gl_Layer (ARB_shader_viewport_layer_array), so that one instanced draw
    /// serves many layers; else each layer is drawn by itself.
    bool layerFromVertexShader = false;
};

}  // namespace penumbra
