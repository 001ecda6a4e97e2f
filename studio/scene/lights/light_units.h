// SPDX-License-Identifier: Apache-2.0
// From the photometric quantities in which files state lights to the radiance that a light with a size emits.
//
// Penumbra states every light that has a size by the luminance L of its surface, in nits (cd/m^2), as UsdLux
// does; glTF states punctual lights by intensity (cd) or illuminance (lx). All lights here are Lambertian: L
// is the same in every direction.
#pragma once

namespace penumbra::studio {

/// Luminance of a sphere of `radius_m` > 0 that, seen from afar, is a point of `intensity_cd`.
///
/// From any side the sphere shows a disk of area pi r^2, and intensity is luminance times projected area: I =
/// L pi r^2.
float radianceFromIntensity_nits(float intensity_cd, float radius_m);

/// Luminance of a disk of the sky, `angle_rad` across (full angle, in (0, pi]), that lights a surface facing
/// its centre with `illuminance_lux`.
///
/// With a = theta/2: E = integral of L cos over the cap = 2 pi L integral_0^a cos t sin t dt = pi L sin^2 a.
float radianceFromIlluminance_nits(float illuminance_lux, float angle_rad);

}  // namespace penumbra::studio
