// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/common/overlapping_casters.h"

#include <algorithm>

namespace penumbra {
namespace {

bool doAnyOverlap(std::pmr::vector<SeenBox>& boxes) {
    std::ranges::sort(boxes, {}, [](const SeenBox& seen) { return seen.min.x; });
    for (auto first = boxes.begin(); first != boxes.end(); ++first) {
        for (auto next = first + 1; next != boxes.end() && next->min.x < first->max.x; ++next) {
            if (next->min.y < first->max.y && first->min.y < next->max.y) return true;
        }
    }
    return false;
}

}  // namespace

SeenBox seenBy(const LightCamera& camera, const BoxCorners& box) {
    SeenBox seen;
    for (const glm::dvec3& corner : box) {
        const glm::dvec3 p = camera.faceFromLight * glm::dvec4(corner, 1);
        // What reaches behind the camera may be anywhere before it.
        const bool isBefore = camera.orthographic || p.z > 0;
        const glm::dvec2 place = camera.orthographic ? glm::dvec2(p) : glm::dvec2(p) / p.z;
        seen.min =
            isBefore ? glm::min(seen.min, place) : glm::dvec2(-std::numeric_limits<double>::infinity());
        seen.max = isBefore ? glm::max(seen.max, place) : glm::dvec2(std::numeric_limits<double>::infinity());
        seen.farthest_m = std::max(seen.farthest_m, p.z);
    }
    return seen;
}

std::pmr::vector<Caster> overlappingCasters(const ShadowInputs& inputs, const LightSpaceScene& scene,
                                            std::span<const LightCamera> cameras) {
    std::pmr::memory_resource* const memory = gl::ObjectRegistryScope::frameMemory();
    std::pmr::vector<Caster> casters(inputs.casters.begin(), inputs.casters.end(), memory);
    std::pmr::vector<bool> isBefore(casters.size(), false, memory);  // something that receives
    bool doOverlap = false;
    for (const LightCamera& camera : cameras) {
        double deepest_m = -std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < casters.size(); ++i) {
            if (casters[i].receives && camera.mightSee(scene.boxes[i]))
                deepest_m = std::max(deepest_m, seenBy(camera, scene.boxes[i]).farthest_m);
        }
        std::pmr::vector<SeenBox> before(memory);
        for (std::size_t i = 0; i < casters.size(); ++i) {
            const SeenBox seen = seenBy(camera, scene.boxes[i]);
            if (!casters[i].casts || !camera.mightSee(scene.boxes[i]) || seen.farthest_m >= deepest_m)
                continue;
            isBefore[i] = true;
            before.push_back(seen);
        }
        doOverlap = doOverlap || doAnyOverlap(before);
    }
    if (!doOverlap) casters.clear();
    for (std::size_t i = 0; i < casters.size(); ++i) casters[i].casts = isBefore[i];
    return casters;
}

}  // namespace penumbra
