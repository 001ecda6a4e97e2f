// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "penumbra/view.h"
#include "src/device/device_internals.h"
#include "src/gl/texture.h"

namespace penumbra {

/// Moves receivers from the facets of coarse meshes onto the smooth surface that their shading normals tell
/// of, and gives them its horizon, so that facets do not show in the terminator. Facets then lie below all
/// that a receiver's horizon lets it see of its own mesh, so that whatever hides the light hides it still.
///
/// After Johannes Hanika, "Hacking the Shadow Terminator" (Ray Tracing Gems II, 2021), who starts shadow rays
/// there. Here the view is changed, which all techniques read; receivers stay in their pixels.
class SmoothSurface {
  public:
    explicit SmoothSurface(Device::Internals& device);

    /// Replaces the view's depths and normals, both of which it has; they are kept until the next call. All
    /// textures show the view's picture and nothing else.
    void run(View& view);

  private:
    gl::Program program_;
    gl::Texture depths_, normals_;
};

}  // namespace penumbra
