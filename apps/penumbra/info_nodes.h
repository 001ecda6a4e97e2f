// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "studio/scene/scene.h"

namespace penumbra::studio {

/// Prints the nodes with a mesh whose names match a pattern (`*`, `?`): bounds in the file's coordinates,
/// triangles, materials, whether they cast. As a table, or as JSON: a list of {"node", "min", "max",
/// "triangles", "materials", "casts", "receives"}. Throws UsageError where none matches.
void printNodes(const Scene& scene, const SceneMoment& moment, const std::string& pattern, bool json);

}  // namespace penumbra::studio
