// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory_resource>
#include <vector>

#include "src/techniques/common/light_camera.h"

namespace penumbra {

/// The cameras of fitLightCameras with square windows, so that a distance in the map is the same in all
/// directions, and wide enough that blockers whose penumbra may reach a receiver are in the map (as far as a
/// sixth of the window).
LightCameras fitMapCameras(const AreaLight& light, const LightSpaceScene& scene, int mapSize_px);

/// Appends everything that the maps depend on but their parameters: equal numbers, equal maps.
void appendMapKey(std::pmr::vector<double>& key, const ShadowInputs& inputs, const LightSpaceScene& scene,
                  std::span<const LightCamera> cameras);

}  // namespace penumbra
