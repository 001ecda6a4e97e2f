// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory_resource>
#include <vector>

#include "src/techniques/common/light_camera.h"

namespace penumbra::shadow_width_map {

/// The cameras of fitLightCameras with square windows, so that a distance in the map is the same in all
/// directions, and wide enough that blockers whose penumbra may reach a receiver are in the map (as far as a
/// sixth of the window). Axes, windows and planes are of coarse grids, so that small moves of the view keep
/// the cameras, bit for bit. `splits`: a distant light gets several where `hard` does, the finest first.
LightCameras fitMapCameras(const AreaLight& light, const LightSpaceScene& scene, int mapSize_px,
                           bool splits = false);

/// Appends everything that the maps depend on but their parameters: equal numbers, equal maps.
void appendMapKey(std::pmr::vector<double>& key, const ShadowInputs& inputs, const LightSpaceScene& scene,
                  std::span<const LightCamera> cameras);

/// How far away, along the cameras' axes, a plane is that lies behind all that casts: A of section 3.
double planeBehindCasters_m(const ShadowInputs& inputs, const LightSpaceScene& scene,
                            std::span<const LightCamera> cameras);

}  // namespace penumbra::shadow_width_map
