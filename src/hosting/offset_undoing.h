// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "penumbra/view.h"
#include "src/device/device_internals.h"
#include "src/gl/texture.h"

namespace penumbra {

/// Takes out of depths what glPolygonOffset has added (OpenGL 4.5, section 14.6.5): factor times the steeper
/// slope of the triangle, and units times the least difference that depths can have.
class OffsetUndoing {
  public:
    explicit OffsetUndoing(Device::Internals& device);

    /// `depthTexture` shows the view's picture and nothing else, and so does `normalTexture`, which may be 0: then
    /// slopes come from the depths alone, and triangles smaller than three pixels are guessed at. The result is kept
    /// until the next call.
    GLuint run(GLuint depthTexture, GLuint normalTexture, const View& view);

  private:
    gl::Program program_;
    gl::Texture undone_;
};

}  // namespace penumbra
