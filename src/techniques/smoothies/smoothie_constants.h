// SPDX-License-Identifier: Apache-2.0
// What a light and its camera mean for the size of smoothies: see README.md, "The size of a smoothie".
#pragma once

#include "src/techniques/common/light_camera.h"
#include "src/techniques/smoothies/smoothies_io.h"

namespace penumbra::smoothies {

/// The technique's parameters, as Smoothies::describe names them.
struct SmoothieSettings {
    int mapSize_px = 1024;
    float t = 0;  ///< in half windows of a light frustum that the view does not change; 0: from the light
    bool inner = true;
    int buffer = 0;  ///< what a texel of the smoothie buffer keeps: SmoothieBuffer::Keeps
    bool remap = true;
    int falloff = 0;
};

SmoothieConstants smoothieConstants(const SmoothieSettings& settings, const ShadowInputs& inputs,
                                    const LightCamera& camera, const LightSpaceScene& scene);

}  // namespace penumbra::smoothies
