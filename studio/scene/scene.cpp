// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/scene.h"

#include <algorithm>

namespace penumbra::studio {

void Bounds::include(const glm::vec3& point) {
    if (empty()) {
        min = max = point;
        return;
    }
    min = glm::min(min, point);
    max = glm::max(max, point);
}

double Scene::duration_s() const {
    double longest_s = 0;
    for (const Animation& animation : animations)
        if (animation.plays) longest_s = std::max(longest_s, animation.duration_s);
    return longest_s;
}

}  // namespace penumbra::studio
