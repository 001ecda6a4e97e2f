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
    /// Maps a sample: 1, or up to 6 where receivers surround the light, or under the sun for parts of the
    /// picture that are alike in the size of their pixels, the finest first; 0: nothing receives.
    int faces = 0;
    bool isCube = false;
    bool orthographic = false;
    std::array<glm::dmat3, 6> faceFromLight;
    double near_m = 0, far_m = 0;  ///< as LightCamera has them, for all samples
    double nearestBlocker_m =
        0;  ///< depth of the nearest caster as any sample sees it; not of a cube's faces
    std::vector<SampleCamera> cameras;  ///< `faces` a sample

    /// Fits them to everything that receives, with maps of the size that is asked for, or larger ones where
    /// that is better for the light and all of a sample's together have no more than `memory_texels`: returns
    /// the size. Keeps its memory.
    int fitMaps(const AreaLight& light, const LightSurface& surface, std::span<const LightSample> samples,
                const LightSpaceScene& scene, int mapSize_px, double memory_texels);

  private:
    void fit(const AreaLight& light, const LightSurface& surface, std::span<const LightSample> samples,
             const LightSpaceScene& scene, int mapSize_px);
    void takeReceivers(int part, std::span<const ReceiverRegion::Polygon> polygons);
    void fitWindow(const LightSample& sample, std::span<const glm::dvec3> receivers, int mapSize_px);
    void fitWindows(std::span<const LightSample> samples, int mapSize_px);
    void add(const glm::dmat4& faceFromLight, const glm::dvec3& origin, glm::dvec2 windowMin,
             glm::dvec2 windowMax, int mapSize_px);

    std::array<std::vector<glm::dvec3>, 6>
        receivers_;  // face space of face 0; under the sun those of each part
};

}  // namespace penumbra::light_sampling
