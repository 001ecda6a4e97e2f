// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "studio/scene/scene.h"

namespace penumbra::studio::python {

/// Triangles out of arrays, in the world, and what they do to light.
struct ArrayMesh {
    Mesh mesh;  ///< its name is that of its node, too
    glm::vec3 color{0};
    bool casts = true, receives = true;
};

}  // namespace penumbra::studio::python
