// SPDX-License-Identifier: Apache-2.0
// A camera as a person places it: from here, at that. What the viewer's mouse moves and what --look-from
// states.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "studio/scene/builtin/placing.h"

namespace penumbra::studio {

struct LookAt {
    glm::vec3 eye{0, 1, 5};
    glm::vec3 target{0, 0, 0};      ///< must differ from `eye`
    float fov_deg = 40;             ///< whole angle from the picture's bottom to its top
    std::optional<float> height_m;  ///< orthographic where set: whole height of the picture
};

/// Equal numbers give equal bits, so that a camera that travels as text shows the same picture.
inline Camera lookAtCamera(const LookAt& look) {
    Camera made = camera("free", look.eye, look.target, glm::radians(look.fov_deg));
    made.orthographicHeight_m = look.height_m;
    return made;
}

}  // namespace penumbra::studio
