// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "penumbra/technique.h"
#include "src/gl/framebuffer.h"
#include "src/gl/program.h"
#include "src/gl/texture.h"
#include "src/techniques/smoothies/smoothie_construction.h"

namespace penumbra {

/// Chan and Durand 2003, section 3, step 4: smoothies drawn into the light's window. A texel keeps the number
/// of the edge in whose penumbra it lies deepest, in the layers of layers.glsl for each camera.
class SmoothieBuffer {
  public:
    explicit SmoothieBuffer(Device& device);

    /// Of half the depth maps' size.
    void draw(const SilhouetteExtractor& silhouettes, const gl::Buffer& edges, const SurfaceMaps& surfaces,
              const gl::Buffer& constants);

    const gl::Texture& deepestEdges() const { return deepest_; }
    void inspect(InspectionVisitor& visitor) const;

  private:
    gl::Program smoothie_;
    gl::Texture deepest_, order_;
    gl::Framebuffer framebuffer_;
    int layers_ = 0;
};

}  // namespace penumbra
