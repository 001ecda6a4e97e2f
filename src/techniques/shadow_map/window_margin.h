// SPDX-License-Identifier: Apache-2.0
// Filters look beside the receivers that a light camera's window was fitted to; these make room for that.
#pragma once

#include <span>

#include "src/techniques/common/light_camera.h"

namespace penumbra::shadow_map {

/// Adds `texels` on each side of each window. Where cameras are a cube's faces, their maps then overlap by as
/// much, and a kernel near a face's edge finds all its texels in the face it started in.
void widenByTexels(std::span<LightCamera> cameras, double texels, int mapSize_px);

/// Adds what blockers between the receivers and any part of the light can reach beyond the windows, going by
/// the casters' boxes, but at most half a window on each side.
void widenForLight(std::span<LightCamera> cameras, const AreaLight& light, const LightSpaceScene& scene);

}  // namespace penumbra::shadow_map
