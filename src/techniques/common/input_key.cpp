// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/common/input_key.h"

namespace penumbra {

void appendView(std::vector<std::byte>& key, const View& view) {
    appendBytes(key, view.width_px);
    appendBytes(key, view.height_px);
    appendBytes(key, view.viewFromWorld);
    appendBytes(key, view.clipFromView);
    appendBytes(key, view.depth.range);
    appendBytes(key, view.depth.reversed);
}

void appendLight(std::vector<std::byte>& key, const AreaLight& light) {
    appendBytes(key, light.shape);
    appendBytes(key, light.worldFromLight);
    for (const float size : {light.width_m, light.height_m, light.length_m, light.radius_m, light.angle_rad})
        appendBytes(key, size);
    appendBytes(key, light.twoSided);
    appendBytes(key, light.radianceTexture);
}

bool appendInputs(std::vector<std::byte>& key, const ShadowInputs& inputs) {
    appendView(key, inputs.view);
    appendLight(key, inputs.light);
    bool isKnown = true;
    for (const Caster& caster : inputs.casters) {
        appendBytes(key, caster.mesh->id());
        appendBytes(key, caster.mesh->revision());
        appendBytes(key, caster.worldFromMesh);
        appendBytes(key, caster.casts);
        appendBytes(key, caster.receives);
        const AlphaMask& mask = caster.alphaMask;
        appendBytes(key, mask.texture);
        appendBytes(key, mask.revision);
        appendBytes(key, mask.factor);
        appendBytes(key, mask.cutoff);
        isKnown = isKnown && (mask.texture == 0 || mask.revision != 0);
    }
    return isKnown;
}

}  // namespace penumbra
