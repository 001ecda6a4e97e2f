// SPDX-License-Identifier: Apache-2.0
// Watts, which mean nothing without the program that they were typed into: none counts the electricity, and
// one that has been mended counts otherwise than before.
#pragma once

#include "studio/scene/json/json_view.h"
#include "studio/scene/scene.h"

namespace penumbra::studio {

/// Whether a light states its power in place of an intensity.
bool statesWatts(const JsonView& light);

/// What `watts` of the `program` that it names (Blender, with its version) make a light of this shape shine,
/// in nits or, where it has no size, candela. Throws InputError for another program, and one without a
/// version.
Emission readWatts(const JsonView& light, const AreaLight& shape);

}  // namespace penumbra::studio
