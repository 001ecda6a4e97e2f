// SPDX-License-Identifier: Apache-2.0
// For whoever has just connected Penumbra to a renderer, and sees shadows that are not right.
#pragma once

#include <string>
#include <vector>

#include "penumbra/technique.h"

namespace penumbra {

struct Diagnosis {
    /// The share of the pixels that show a surface, in the depths or by the casters, where both show the
    /// same one.
    double agreement = 0;
    /// What is likely wrong, and what to do: one sentence each, the likeliest first. Empty: nothing is.
    std::vector<std::string> findings{};
    bool fits() const { return findings.empty(); }
};

/// Draws the casters with the view's matrices, compares with the view's depths, and says in words where they
/// differ and which other reading of the inputs would fit: another depth convention, a picture upside down,
/// matrices that are transposed, inverted or of another camera, other units, polygon offset, another sample's
/// place, casters that are missing, too many or elsewhere.
///
/// Takes tens of milliseconds and waits for the device: for the first frames, not for every one (see
/// DeviceOptions::diagnose). Throws as Technique::render does on what is refused anyway.
PENUMBRA_API Diagnosis diagnose(Device& device, const View& view, std::span<const Caster> casters);

}  // namespace penumbra
