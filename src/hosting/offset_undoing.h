// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "penumbra/view.h"
#include "src/device/device_internals.h"
#include "src/gl/texture.h"
#include "src/hosting/caster_picture.h"

namespace penumbra {

/// Takes out of depths what glPolygonOffset has added (OpenGL 4.5, section 14.6.5): factor times the steeper
/// slope of the triangle, and units times the least difference that depths can have.
class OffsetUndoing {
  public:
    explicit OffsetUndoing(Device::Internals& device);

    /// Replaces the depths of `plain`, which show the view's picture and nothing else. Without normals each
    /// pixel's slopes are those of the caster that it shows; where it shows none (or there is no picture of
    /// them, null) they come from the depths alone, and triangles narrower than three pixels are guessed at.
    /// `plain` then gets normals, too: out of depths where an offset was guessed they would be wrong. All is
    /// kept until the next call. `view` is the host's, whose depths' format tells what a unit is.
    void run(View& plain, const View& view, const CasterPainter* casters);

  private:
    gl::Program program_;
    gl::Texture undone_, normals_;
};

}  // namespace penumbra
