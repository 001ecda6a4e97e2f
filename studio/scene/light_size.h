// SPDX-License-Identifier: Apache-2.0
// Lights with a size and lights without: the one's emission is in nits, the other's in candela or lux.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "studio/scene/scene.h"

namespace penumbra::studio {

/// How much of its emission's unit a light gives to a surface far off that faces it: the area or the solid
/// angle that it shows; 0 for a light of size zero.
float effectOf(const AreaLight& shape);

/// Nits with a size, else candela, or lux of a distant light. The value stays.
void setEmissionUnit(Light& light);

/// Sets one of the light's sizes. Where it becomes or ceases to be zero the unit of emission changes with it,
/// and the illuminance that the light gives from afar stays. A luminaire keeps the size that its file says.
void setSize(Light& light, float AreaLight::*size, float value);

/// What lights without a size are given: a radius to lamps, an angle across to distant lights; 0: nothing.
struct LightSizes {
    float radius_m = 0, angle_rad = 0;
};

/// `inner` with these sizes, at all times.
std::shared_ptr<const Scene::Motion> withSizes(std::shared_ptr<const Scene::Motion> inner,
                                               const LightSizes& sizes);

/// Which of the moment's lights have no size, in one line with the remedy; nothing where all have one.
std::optional<std::string> sizelessHint(const SceneMoment& moment);

}  // namespace penumbra::studio
