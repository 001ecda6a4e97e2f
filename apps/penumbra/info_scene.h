// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "penumbra/promise.h"
#include "studio/scene/scene.h"

namespace penumbra::studio {

/// Prints what a scene holds, called `name` where it has no name of its own, and what `auto` takes for each
/// light to keep `maxError`. As a table, or as JSON: see docs/command-line.md. Throws UsageError where nobody
/// promises so little.
void printScene(const Scene& scene, const std::string& name, double maxError, bool json);

}  // namespace penumbra::studio
