// SPDX-License-Identifier: Apache-2.0
// Where a light of a sidecar is, and where it shines.
#pragma once

#include "studio/scene/json/lined_json.h"
#include "studio/scene/lights/sidecar.h"

namespace penumbra::studio {

/// Reads `translation`, `rotation` or `aim`, `node` or `below`; of a distant light `azimuth` and `altitude`.
void readPlace(const LinedJson& document, const JsonView& object, SidecarLight& read);

}  // namespace penumbra::studio
