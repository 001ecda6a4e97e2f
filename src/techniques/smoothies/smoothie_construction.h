// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/geometry/silhouette_extractor.h"
#include "src/techniques/common/depth_map.h"
#include "src/techniques/smoothies/smoothies_io.h"

namespace penumbra::smoothies {

/// What the light sees where: the nearest caster, and, where there is any, what receives without casting. See
/// surfaces.glsl.
struct SurfaceMaps {
    const DepthMap& casters;
    const DepthMap& receivers;
    bool hasReceivers;

    void bindTo(gl::Pass& pass) const;
};

/// Chan and Durand 2003, section 3, step 3: where the smoothie of each silhouette edge goes, for each light
/// camera, and how wide it is at most. Nothing is read back.
class SmoothieConstruction {
  public:
    explicit SmoothieConstruction(Device& device);

    /// `constants` holds a SmoothieConstants a camera. Room is made for all edges that were examined.
    void build(const SilhouetteExtractor& silhouettes, const SurfaceMaps& surfaces,
               const gl::Buffer& constants, bool isDistant);

    /// A SmoothieEdge for each of the silhouettes' edges, camera after camera.
    const gl::Buffer& edges() const { return smoothieEdges_; }

  private:
    gl::Program farthest_, build_, clearNormals_, addNormals_;
    gl::Buffer farthestTiles_, vertexNormals_, smoothieEdges_;
};

}  // namespace penumbra::smoothies
