// SPDX-License-Identifier: Apache-2.0
// In place of reference_technique.cpp in a build for the bench alone, which has no Embree.
#include "studio/workbench/studio_techniques.h"

namespace penumbra::studio {

std::span<const StudioTechnique> studioTechniques() {
    return {};
}

}  // namespace penumbra::studio
