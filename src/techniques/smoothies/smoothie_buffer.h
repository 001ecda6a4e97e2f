// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "penumbra/technique.h"
#include "src/gl/framebuffer.h"
#include "src/gl/program.h"
#include "src/gl/texture.h"
#include "src/techniques/smoothies/smoothie_construction.h"

namespace penumbra::smoothies {

/// Chan and Durand 2003, section 3, step 4: smoothies drawn into the light's window.
class SmoothieBuffer {
  public:
    enum class Keeps {
        edges,  ///< the number of the edge in whose penumbra a texel lies deepest, in the layers of
                ///< layers.glsl for each camera, at half the depth maps' size
        alpha,  ///< as published: the least alpha and the nearest depth, at the depth maps' size
    };

    explicit SmoothieBuffer(Device& device);

    void draw(Keeps keeps, const SilhouetteExtractor& silhouettes, const gl::Buffer& edges,
              const SurfaceMaps& surfaces, const gl::Buffer& constants);

    const gl::Texture& deepestEdges() const { return deepest_; }
    const gl::Texture& storedAlpha() const { return stored_; }
    void inspect(InspectionVisitor& visitor) const;

  private:
    void drawInto(gl::Pass& pass, const SilhouetteExtractor& silhouettes, const gl::Buffer& edges,
                  const SurfaceMaps& surfaces, const gl::Buffer& constants) const;

    gl::Program deepestEdge_, leastAlpha_;
    gl::Texture deepest_, order_, stored_;
    gl::Framebuffer deepestTarget_, storedTarget_;
    Keeps keeps_ = Keeps::edges;
    int cameras_ = 0;
};

}  // namespace penumbra::smoothies
