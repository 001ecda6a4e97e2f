// SPDX-License-Identifier: Apache-2.0
// The cameras of all samples of a light. They share their axes, so that a receiver is turned into face space
// once for all of them; only the origin (perspective) or the slant (orthographic) and the window differ.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "src/techniques/common/light_camera.h"
#include "src/techniques/light_sampling/light_surface.h"

namespace penumbra::light_sampling {

struct SampleCameras {
    int faces = 0;  ///< maps a sample: 1, or up to 6 where receivers surround the light; 0: nothing receives
    bool isCube = false;
    bool orthographic = false;
    std::array<glm::dmat3, 6> faceFromLight;
    double near_m = 0, far_m = 0;  ///< as LightCamera has them, for all samples
    double nearestBlocker_m =
        0;  ///< depth of the nearest caster as any sample sees it; not of a cube's faces
    std::vector<SampleCamera> cameras;  ///< `faces` a sample

    /// Fits them to everything that receives. Keeps its memory.
    void fit(const AreaLight& light, const LightSurface& surface, std::span<const LightSample> samples,
             const LightSpaceScene& scene, int mapSize_px);

  private:
    void fitWindows(std::span<const LightSample> samples, int mapSize_px);
    void add(const glm::dmat4& faceFromLight, const glm::dvec3& origin, glm::dvec2 windowMin,
             glm::dvec2 windowMax, int mapSize_px);

    std::vector<glm::dvec3> receivers_;  // face space of face 0
};

}  // namespace penumbra::light_sampling
