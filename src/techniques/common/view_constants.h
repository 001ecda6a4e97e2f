// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "penumbra/technique.h"
#include "src/gl/buffer.h"
#include "src/gl/pass.h"
#include "src/gl/pass_timers.h"
#include "src/techniques/common/light_constants.h"
#include "src/techniques/common/view_io.h"

namespace penumbra {

/// From world space to the light's: rotation and translation. A distant light, which has no place, gets its
/// origin in the middle of the casters.
glm::dmat4 lightFromWorld(const ShadowInputs& inputs);

/// Gives shaders the receivers in light space (see view.glsl).
class ViewBinding {
  public:
    ViewBinding() : constants_("view constants") {}
    void fill(const View& view, const glm::dmat4& lightFromWorld);
    void bindTo(gl::Pass& pass) const;

  private:
    gl::ConstantBuffer<ViewConstants> constants_;
    GLuint depth_ = 0, normals_ = 0, receivers_ = 0;
};

/// `out` as an image that passes write.
gl::TextureRef imageOf(const VisibilityBuffer& out);

/// The passes' newest times, for Technique::statistics.
std::vector<PassTime> passTimes(const gl::PassTimers& timers);

}  // namespace penumbra
