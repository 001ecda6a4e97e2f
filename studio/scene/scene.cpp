// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/scene.h"

namespace penumbra::studio {

void Bounds::include(const glm::vec3& point) {
    if (empty()) {
        min = max = point;
        return;
    }
    min = glm::min(min, point);
    max = glm::max(max, point);
}

}  // namespace penumbra::studio
