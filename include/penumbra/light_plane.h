// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace penumbra {

/// What lies in the plane of a rect or disk light, such as the ceiling that a panel is let into, hides
/// nothing of it, and sees nothing of it. A point counts as lying in it up to this far away, in multiples of
/// (its distance from the light's centre + half the diagonal of the light's bounding rectangle): what floats
/// lose of corners and matrices that mean the same plane, some ten roundings of 2^-24, ten times over. 0.1 mm
/// at 10 m.
inline constexpr float lightPlaneTolerance = 1e-5f;

}  // namespace penumbra
