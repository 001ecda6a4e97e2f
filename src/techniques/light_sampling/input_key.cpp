// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/light_sampling/input_key.h"

#include <algorithm>

namespace penumbra {
namespace {

/// A mesh may be replaced by another at the same address, with buffers of the same names: some of its
/// positions and indices tell them apart.
constexpr std::size_t probes = 64;

template <typename T>
void appendProbes(std::vector<std::byte>& key, std::span<const T> values) {
    appendBytes(key, values.size());
    const std::size_t step = std::max<std::size_t>(1, values.size() / probes);
    for (std::size_t i = 0; i < values.size(); i += step) appendBytes(key, values[i]);
}

}  // namespace

bool appendInputs(std::vector<std::byte>& key, const ShadowInputs& inputs) {
    const View& view = inputs.view;
    appendBytes(key, view.width_px);
    appendBytes(key, view.height_px);
    appendBytes(key, view.viewFromWorld);
    appendBytes(key, view.clipFromView);
    appendBytes(key, view.depth.range);
    appendBytes(key, view.depth.reversed);
    const AreaLight& light = inputs.light;
    appendBytes(key, light.shape);
    appendBytes(key, light.worldFromLight);
    for (const float size : {light.width_m, light.height_m, light.radius_m, light.angle_rad})
        appendBytes(key, size);
    appendBytes(key, light.twoSided);
    appendBytes(key, light.radianceTexture);
    bool isKnown = true;
    for (const Caster& caster : inputs.casters) {
        appendBytes(key, caster.mesh);
        appendBytes(key, caster.mesh->revision());
        appendBytes(key, caster.mesh->positionBuffer());
        appendBytes(key, caster.mesh->bounds());
        appendProbes(key, caster.mesh->positions());
        appendProbes(key, caster.mesh->indices());
        appendBytes(key, caster.worldFromMesh);
        appendBytes(key, caster.casts);
        appendBytes(key, caster.receives);
        isKnown = isKnown && caster.alphaMask.texture == 0;
    }
    return isKnown;
}

}  // namespace penumbra
