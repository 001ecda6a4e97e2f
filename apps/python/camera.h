// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "studio/scene/look_at.h"
#include "studio/scene/scene.h"

namespace penumbra::studio::python {

/// A camera of one's own, in the coordinates of the scene's file.
struct OwnCamera {
    glm::dvec3 lookFrom{0}, lookAt{0};
    float fov_deg = 0;
    std::optional<float> height_m;  ///< orthographic where set
};

/// One of the scene's, by index or name, or one's own; none: the scene's first.
using CameraChoice = std::optional<std::variant<int, std::string, OwnCamera>>;

/// Throws UsageError for one that the scene does not have.
Camera chosenCamera(const CameraChoice& choice, const Scene& scene, const SceneMoment& moment);

}  // namespace penumbra::studio::python
