// SPDX-License-Identifier: Apache-2.0
#include "src/automatic/frame_watch.h"

#include <algorithm>
#include <bit>
#include <glm/glm.hpp>
#include <tuple>
#include <utility>

namespace penumbra {
namespace {

/// The same light, or what has become of it a frame later.
bool areOne(const AreaLight& a, const AreaLight& b) {
    const auto form = [](const AreaLight& light) {
        return std::tuple(light.shape, light.width_m, light.height_m, light.length_m, light.radius_m,
                          light.angle_rad, light.twoSided, light.radianceTexture);
    };
    if (form(a) != form(b)) return false;
    const glm::mat4 from = std::bit_cast<glm::mat4>(a.worldFromLight);
    const glm::mat4 to = std::bit_cast<glm::mat4>(b.worldFromLight);
    if (a.shape == LightShape::distant) return glm::distance(from[2], to[2]) <= a.angle_rad;
    return glm::distance(from[3], to[3]) <= std::max({a.width_m, a.height_m, a.length_m, 2 * a.radius_m});
}

}  // namespace

bool FrameWatch::hasStageChanged(const ShadowInputs& inputs) {
    casting_.clear();
    for (const Caster& caster : inputs.casters) {
        if (caster.mesh != nullptr)
            casting_.push_back({caster.mesh->id(), caster.mesh->revision(), caster.worldFromMesh});
    }
    const View& view = inputs.view;
    const bool isSame = view.depthTexture == depthTexture_ && view.viewFromWorld == viewFromWorld_ &&
                        view.clipFromView == clipFromView_ && casting_ == casters_;
    depthTexture_ = view.depthTexture;
    viewFromWorld_ = view.viewFromWorld;
    clipFromView_ = view.clipFromView;
    std::swap(casters_, casting_);
    return !isSame;
}

bool FrameWatch::begins(const ShadowInputs& inputs) {
    const bool hasChanged = hasStageChanged(inputs);
    const auto isThisOne = [&](const AreaLight& light) { return areOne(light, inputs.light); };
    const bool result = hasChanged || lights_.empty() || std::ranges::any_of(lights_, isThisOne);
    if (result) lights_.clear();
    lights_.push_back(inputs.light);
    return result;
}

}  // namespace penumbra
