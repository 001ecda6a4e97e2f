// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "studio/scene/scene.h"

namespace penumbra::studio {

/// The matrices of a camera. Clip-space z is reversed, in [0, 1]: 1 at the near plane; 0 at infinity
/// (perspective) or behind everything (orthographic).
struct CameraView {
    glm::dmat4 viewFromWorld{1};
    glm::dmat4 clipFromView{1};
    bool orthographic = false;
};

/// `bounds` bound what has to be seen: they choose the near plane, and an orthographic camera's far one.
CameraView makeCameraView(const Camera& camera, const Bounds& bounds, int width_px, int height_px);

}  // namespace penumbra::studio
