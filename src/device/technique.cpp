// SPDX-License-Identifier: Apache-2.0
#include "penumbra/technique.h"

#include <algorithm>

namespace penumbra {

bool needsColor(const AreaLight& light, std::span<const Caster> casters) {
    return light.radianceTexture != 0 || std::ranges::any_of(casters, isPane);
}

void Technique::renderLights(const FrameInputs& frame) {
    for (std::size_t i = 0; i < frame.lights.size(); ++i) {
        const auto& [light, out, castsShadow] = frame.lights[i];
        ShadowInputs inputs{.view = frame.view, .light = light};
        if (castsShadow) inputs.casters = frame.casters;
        render(inputs, *out);
        if (frame.answered) frame.answered(i);
    }
}

}  // namespace penumbra
