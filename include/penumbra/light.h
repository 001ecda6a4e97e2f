// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "penumbra/math.h"

namespace penumbra {

/// The shapes a light can have; names and axes are UsdLux's.
enum class LightShape {
    rect,      ///< `width_m` x `height_m` in the light's XY plane, emitting along -Z
    disk,      ///< `radius_m` in the light's XY plane, emitting along -Z
    sphere,    ///< `radius_m` around the light's origin, emitting in all directions
    distant,   ///< a disk of the sky, `angle_rad` across, whose light travels along the light's -Z
    cylinder,  ///< a tube, `length_m` along the light's X axis and `radius_m` around it, emitting outwards;
               ///< its flat ends are dark, and from inside it is dark, too
};

/// A light that has a size. Only what visibility depends on: colour and intensity are the host's business.
///
/// A size of zero is legal for every shape and gives a hard shadow from the light's centre.
struct AreaLight {
    LightShape shape = LightShape::rect;

    /// Rotation and translation of the light; its columns must be orthonormal (sizes are given below, never
    /// by scale). The translation is ignored by distant lights.
    Mat4 worldFromLight{};

    float width_m = 0;    ///< rect, >= 0
    float height_m = 0;   ///< rect, >= 0
    float length_m = 0;   ///< cylinder, >= 0
    float radius_m = 0;   ///< disk, sphere and cylinder, >= 0
    float angle_rad = 0;  ///< distant: full angle seen from the surface, in [0, pi]

    /// Rect and disk: emits along +Z too. The others have no back.
    bool twoSided = false;

    /// Rect only: name of a GL_TEXTURE_2D in the current context whose RGB is the radiance over the light, or
    /// 0. Borrowed. Texture row 0 lies at the light's -Y edge, column 0 at its -X edge. A textured light's
    /// visibility has three channels, each weighting the light's area by that channel's radiance.
    std::uint32_t radianceTexture = 0;
};

}  // namespace penumbra
